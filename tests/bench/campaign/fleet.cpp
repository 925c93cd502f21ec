#include "tests/bench/campaign/fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <thread>
#include <utility>

#include "cell/campaign/spread.h"
#include "cell/missions/fleet/fleet_executive_options.h"
#include "cell/runtime/fleet_plant.h"
#include "plant_models/assemblies/fleet_floor.h"
#include "runtime/ground/result/value_or_throw.h"
#include "supervisor/fleet/executive/fleet_executive.h"

namespace stepwright::campaign {
namespace {

using nlohmann::json;
using run::Phase;
using support::SimulatedController;

constexpr std::chrono::seconds kHold{60};    // of the scan clock: nobody comes to a fleet that is held
constexpr std::chrono::seconds kHangs{600};  // of wall time, for all of a run
constexpr const char* kAllDone = "all that could be done is done";

// What is missing and why; `open`: something is missing for no reason that could be told.
struct Missing {
  std::string text;
  bool open = false;
};

Missing missing_of(const run::RunRecord& record) {
  Missing missing;
  const auto found = record.details.find(fleet::kFleetDetails);
  const json fleet = found == record.details.end() ? json() : json::parse(found->second, nullptr, false);
  if (!fleet.is_object()) return {"there is no document of the fleet", true};
  for (const json& goal : fleet.at("goals")) {
    if (goal.at("delivered") >= goal.at("amount")) continue;
    const std::string why = goal.value("reason", std::string());
    missing.open = missing.open || why.empty();
    missing.text += fmt::format("{}{}: {}", missing.text.empty() ? "" : "; ",
                                goal.at("name").get<std::string>(), why.empty() ? "no reason" : why);
  }
  return missing;
}

// Empty if the fleet was stopped because of what happened and not before all was done that could be.
std::string wrong_stop(const FleetRun& run, double ended_s) {
  const auto& record = run.record;
  if (!record.message.starts_with(kAllDone)) return "given up: " + record.message;
  const Missing missing = missing_of(record);
  if (missing.open) return record.message;
  const bool mended = run.moment.until_s > 0.0 && run.moment.until_s < ended_s;
  if (run.moment.kind == FleetKind::Order || mended) return "nothing stands in the way: " + record.message;
  return {};
}

void judge(const SimulatedController& controller, double ended_s, FleetRun& run) {
  const bool done = run.record.phase == Phase::Done;
  const bool met = std::ranges::all_of(run.record.goal, &run::GoalRecord::met);
  for (const char* truth : {"overlaps", "obstacle_overlaps", "contacts"}) {
    if (controller.plant_value(truth) != 0.0)
      run.why = fmt::format("{}: {}", truth, controller.plant_value(truth));
  }
  if (run.why.empty()) run.why = wrong_end(run.record, controller);
  if (!run.why.empty()) return;
  if (done && !met) {
    run.why = "done, and not everything is delivered";
  } else if (!done) {
    run.why = wrong_stop(run, ended_s);
  }
  if (run.why.empty()) run.verdict = done ? Verdict::GoalReached : Verdict::SafeStop;
}

// Aborts a run that hangs.
class Watchdog {
 public:
  explicit Watchdog(fleet::FleetExecutive& executive)
      : thread_([this, &executive](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          if (over_.wait_for(lock, stop, kHangs, [] { return false; }) || stop.stop_requested()) return;
          bit_ = true;
          executive.request_abort();
        }) {}

  bool bit() const { return bit_; }

 private:
  std::mutex mutex_;
  std::condition_variable_any over_;
  std::atomic<bool> bit_{false};
  std::jthread thread_;
};

void add(const FleetRun& run, FleetClass& figures) {
  ++figures.runs;
  if (run.verdict == Verdict::GoalReached) ++figures.delivered;
  if (run.verdict == Verdict::SafeStop) ++figures.safe_stops;
  if (run.verdict == Verdict::Lost) ++figures.lost;
  for (const run::Incident& incident : run.record.incidents) {
    if (incident.replan_ms <= 0.0) continue;
    ++figures.plans;
    figures.plan_ms_sum += incident.replan_ms;
  }
  figures.longest_plan_ms = std::max(figures.longest_plan_ms, run.longest_plan_ms);
}

double mean(double sum, std::uint64_t count) {
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

struct FleetCell::Parts {
  config::CellConfig config =
      result::value_or_throw(config::load_cell_config(STEPWRIGHT_SOURCE_DIR "/tests/cells/fleet/cell.toml"));
  fleet::FleetPlanning planning = result::value_or_throw(missions::open_fleet_planning(config));
};

FleetCell::FleetCell() : parts_(std::make_unique<Parts>()) {}
FleetCell::~FleetCell() = default;

FleetRun run_fleet(FleetCell& cell, std::uint64_t seed) {
  auto& [config, planning] = cell.parts();
  FleetRun run;
  run.moment = fleet_moment(seed, planning.problem());
  config::PlantConfig plant = config.plant;
  plant.seed = seed;
  SimulatedController controller(result::value_or_throw(assemblies::FleetFloor::create(
                                     result::value_or_throw(cell_runtime::fleet_parameters(plant)))),
                                 bridge::default_fleet_wires(planning.problem().vehicles.size()),
                                 {config.image.input_bytes, config.image.output_bytes}, run.moment.faults);
  fleet::FleetExecutiveOptions options = missions::fleet_executive_options(config);
  options.requests = run.moment.requests;
  options.hold = kHold;
  options.attended = false;
  options.journal.clear();
  try {
    fleet::FleetExecutive executive(planning, controller, std::move(options), {});
    const Watchdog watchdog(executive);
    run.record = executive.run();
    const auto snapshot = controller.snapshot();
    judge(controller, snapshot ? 1e-9 * static_cast<double>(snapshot->time_ns) : 0.0, run);
    if (watchdog.bit()) {
      run.verdict = Verdict::Lost;
      run.why = "it hangs";
    }
  } catch (const std::exception& problem) {  // nothing happens any more
    run.why = problem.what();
  }
  for (const run::Incident& incident : run.record.incidents)
    run.longest_plan_ms = std::max(run.longest_plan_ms, incident.replan_ms);
  return run;
}

std::uint64_t FleetFigures::runs() const {
  const auto all = of.find("all");
  return all == of.end() ? 0 : all->second.runs;
}

FleetFigures fleet_campaign(std::uint64_t first, std::uint64_t runs, unsigned threads,
                            const std::function<void(std::uint64_t done)>& told,
                            const std::atomic<bool>* cancel) {
  FleetFigures figures;
  const auto run = [&](std::uint64_t i) {
    thread_local FleetCell cell;
    return run_fleet(cell, first + i);
  };
  const auto take = [&](FleetRun result) {
    add(result, figures.of[to_string(result.moment.kind)]);
    add(result, figures.of["all"]);
    if (result.verdict == Verdict::Lost) figures.lost.push_back(result);
    figures.newest = std::move(result);
  };
  figures.wall_s = spread(runs, threads, told, cancel, run, take);
  std::ranges::sort(figures.lost, {}, [](const FleetRun& each) { return each.moment.seed; });
  return figures;
}

std::string table(const FleetFigures& figures) {
  std::string text = fmt::format("{:<8} {:>6} {:>9} {:>6} {:>5} {:>6} {:>9} {:>9}\n", "moment", "runs",
                                 "delivered", "safe", "lost", "plans", "plan", "longest");
  const auto out = std::back_inserter(text);
  for (const auto& [kind, f] : figures.of) {
    fmt::format_to(out, "{:<8} {:>6} {:>9} {:>6} {:>5} {:>6} {:>9.0f} {:>9.0f}\n", kind, f.runs, f.delivered,
                   f.safe_stops, f.lost, f.plans, mean(f.plan_ms_sum, f.plans), f.longest_plan_ms);
  }
  fmt::format_to(out, "plan, longest: ms; {:.1f} s\n", figures.wall_s);
  for (const FleetRun& run : figures.lost) {
    fmt::format_to(out, "LOST seed {} ({}): {}\n", run.moment.seed, run.moment.story, run.why);
    for (const run::Incident& incident : run.record.incidents) {
      if (incident.response == run::Response::GoOn) continue;
      fmt::format_to(out, "  {:.2f} s: {}\n", incident.time_s, fmt::join(incident.evidence, "; "));
    }
  }
  return text;
}

std::string to_json(const FleetFigures& figures, std::uint64_t first, unsigned threads) {
  json document = {
      {"cell", "fleet"}, {"first_seed", first}, {"threads", threads}, {"wall_s", figures.wall_s}};
  document["classes"] = json::array();
  for (const auto& [kind, f] : figures.of) {
    json entry = {{"class", kind},
                  {"runs", f.runs},
                  {"goals_reached", f.delivered},
                  {"safe_stops", f.safe_stops},
                  {"lost", f.lost},
                  {"plans", f.plans},
                  {"plan_mean_ms", mean(f.plan_ms_sum, f.plans)},
                  {"plan_max_ms", f.longest_plan_ms}};
    if (kind == "all") {
      document.update(entry);
    } else {
      document["classes"].push_back(std::move(entry));
    }
  }
  document["lost_seeds"] = json::array();
  for (const FleetRun& run : figures.lost)
    document["lost_seeds"].push_back(
        {{"seed", run.moment.seed}, {"story", run.moment.story}, {"why", run.why}});
  return document.dump(2);
}

}  // namespace stepwright::campaign
