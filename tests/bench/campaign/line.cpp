#include "tests/bench/campaign/line.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/campaign/spread.h"
#include "plant_models/assemblies/line_layout.h"
#include "plant_models/core/counter_random.h"
#include "tests/support/conveyor_cell.h"

namespace stepwright::campaign {
namespace {

using nlohmann::json;
using run::Incident;
using run::IncidentKind;
using run::Phase;
using run::Response;
using support::PlantFault;
using support::SimulatedController;

constexpr std::initializer_list<const char*> kBelts = {"in", "r", "d1", "d2", "e", "t"};

// "jam_d1" -> "jam"; the numbers of boxes are values.
std::string kind_of(const std::string& fault) {
  for (const char* kind : {"jam", "stuck_push", "stuck_eye", "slip"}) {
    if (fault.rfind(kind, 0) == 0) return kind;
  }
  return fault;
}

std::string story_of(const std::vector<PlantFault>& faults) {
  std::string story;
  for (const PlantFault& fault : faults)
    fmt::format_to(std::back_inserter(story), "{}{} = {:g} at {:g} s", story.empty() ? "" : ", ", fault.name,
                   fault.value, fault.at_s);
  return story;
}

// Empty if the line was stopped for a reason that its fault can give, and the report tells of it.
std::string wrong_stop_of(const LineRun& run) {
  if (std::string wrong = wrong_stop(run.record); !wrong.empty()) return wrong;
  if (run.record.message.empty()) return "the stop has no message";
  const Incident& last = run.record.incidents.back();
  if (last.kind == IncidentKind::ProgramFault || last.kind == IncidentKind::Operator ||
      last.kind == IncidentKind::Leak) {
    return fmt::format("stopped for '{}': {}", to_string(last.kind), run.record.message);
  }
  // What somebody has put right is no reason to give up.
  if (run.fault == "press_estop") return "gave up after an emergency stop: " + run.record.message;
  return {};
}

// The boxes where the order wants them. One that somebody took out of its chute was there: what stands before
// the others of that chute is gone for the plant, and has passed the chute's counter for everybody else.
std::map<int, std::pair<int, int>> ordered(const SimulatedController& controller) {
  constexpr double kTakenAway = 3.0;
  auto boxes = executive::ordered_boxes();
  const auto chutes = assemblies::make_layout({}).chutes;
  for (const auto& [box, place] : executive::ordered_boxes()) {
    const std::string name = "box_" + std::to_string(box);
    const auto& area = chutes.at(static_cast<std::size_t>(place.first) - 1).area;
    const bool inside =
        area.contains({controller.plant_value(name + "_x"), controller.plant_value(name + "_y")});
    if (controller.plant_value(name + "_state") != kTakenAway || !inside) continue;
    boxes[box] = {0, 0};
    for (auto& [other, its] : boxes) {
      if (its.first == place.first && its.second > place.second) --its.second;
    }
  }
  return boxes;
}

void judge(const SimulatedController& controller, LineRun& run) {
  const bool done = run.record.phase == Phase::Done;
  run.why = wrong_end(run.record, controller);
  if (!run.why.empty()) return;
  if (controller.plant_value("collisions") != 0.0) {
    run.why = "a paddle met a belt";
  } else if (done && executive::sorted_boxes(controller) != ordered(controller)) {
    run.why = "the boxes are not where they were ordered";
  } else if (!done) {
    run.why = wrong_stop_of(run);
  }
  if (run.why.empty()) run.verdict = done ? Verdict::GoalReached : Verdict::SafeStop;
}

void add(const LineRun& run, LineClass& figures) {
  ++figures.runs;
  if (run.verdict == Verdict::GoalReached) ++figures.goals;
  if (run.verdict == Verdict::SafeStop) ++figures.safe_stops;
  if (run.verdict == Verdict::Lost) ++figures.lost;
  figures.replans += run.record.replans.size();
  figures.worst_replans = std::max<std::uint64_t>(figures.worst_replans, run.record.replans.size());
  figures.incidents += run.record.incidents.size();
  for (const Incident& incident : run.record.incidents) figures.decision_ms_sum += incident.decision_ms;
}

double mean(double sum, std::uint64_t count) {
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

std::vector<PlantFault> line_faults(std::uint64_t seed) {
  const core::CounterRandom random(seed, 900);
  std::uint64_t draw = 0;
  const auto pick = [&](std::uint64_t count) { return random.bits(draw++) % count; };
  const auto name = [&](const std::string& kind, std::initializer_list<const char*> parts) {
    return kind + *(parts.begin() + pick(parts.size()));
  };
  const double from_s = 0.5 + 0.1 * static_cast<double>(pick(400));
  const double until_s = from_s + 3.0 + static_cast<double>(pick(20));
  const auto mended = [&](const std::string& fault, double wrong, double right) {
    return std::vector<PlantFault>{{from_s, fault, wrong},
                                   {until_s, fault, right},
                                   {until_s + 1.0, "press_reset", 1},
                                   {until_s + 1.5, "press_reset", 0}};
  };
  switch (pick(7)) {
    case 0:
      return mended(name("jam_", kBelts), 1, 0);
    case 1:
      return mended(name("stuck_push_", {"1", "2", "e", "t"}), 1, 0);
    case 2:
      return mended(name("slip_", kBelts), 0.1 * static_cast<double>(pick(3)), 1);
    case 3:
      return mended("press_estop", 1, 0);
    case 4:
      return {{from_s, name("stuck_eye_", {"in", "r", "d1", "d2", "e", "t", "t1"}),
               static_cast<double>(pick(2))}};
    case 5:
      return {{from_s, "lose_box", static_cast<double>(1 + pick(5))}};
    default:
      return {{from_s, "exchange_boxes", static_cast<double>(1 + pick(4))}};
  }
}

LineRun run_line(std::uint64_t seed) {
  LineRun run;
  run.seed = seed;
  const std::vector<PlantFault> faults = line_faults(seed);
  run.fault = faults.front().name;
  run.story = story_of(faults);
  SimulatedController controller = executive::conveyor_controller(seed, faults);
  try {
    run.record = executive::run_conveyor(controller);
    judge(controller, run);
  } catch (const std::exception& problem) {  // a run that hangs
    run.why = problem.what();
  }
  return run;
}

std::uint64_t LineFigures::runs() const {
  const auto all = of.find("all");
  return all == of.end() ? 0 : all->second.runs;
}

LineFigures line_campaign(std::uint64_t first, std::uint64_t runs, unsigned threads,
                          const std::function<void(std::uint64_t done)>& told,
                          const std::atomic<bool>* cancel) {
  LineFigures figures;
  const auto run = [&](std::uint64_t i) { return run_line(first + i); };
  const auto take = [&](LineRun result) {
    add(result, figures.of[kind_of(result.fault)]);
    add(result, figures.of["all"]);
    if (result.verdict == Verdict::Lost) figures.lost.push_back(std::move(result));
  };
  figures.wall_s = spread(runs, threads, told, cancel, run, take);
  std::sort(figures.lost.begin(), figures.lost.end(),
            [](const LineRun& a, const LineRun& b) { return a.seed < b.seed; });
  return figures;
}

std::string table(const LineFigures& figures) {
  std::string text = fmt::format("{:<14} {:>6} {:>6} {:>6} {:>5} {:>8} {:>5} {:>9}\n", "fault", "runs",
                                 "goal", "safe", "lost", "replans", "most", "decision");
  const auto out = std::back_inserter(text);
  for (const auto& [kind, f] : figures.of) {
    fmt::format_to(out, "{:<14} {:>6} {:>6} {:>6} {:>5} {:>8.2f} {:>5} {:>9.1f}\n", kind, f.runs, f.goals,
                   f.safe_stops, f.lost, mean(static_cast<double>(f.replans), f.runs), f.worst_replans,
                   mean(f.decision_ms_sum, f.incidents));
  }
  fmt::format_to(out, "decision: ms, mean; {:.1f} s\n", figures.wall_s);
  for (const LineRun& lost : figures.lost) {
    fmt::format_to(out, "LOST seed {} ({}): {}\n", lost.seed, lost.story, lost.why);
    for (const run::Replan& replan : lost.record.replans)
      fmt::format_to(out, "  {:.2f} s after {}: {}\n", replan.time_s, replan.after_action, replan.cause);
  }
  return text;
}

std::string to_json(const LineFigures& figures, std::uint64_t first, unsigned threads) {
  json document = {
      {"cell", "conveyor"}, {"first_seed", first}, {"threads", threads}, {"wall_s", figures.wall_s}};
  document["classes"] = json::array();
  for (const auto& [kind, f] : figures.of) {
    json entry = {{"class", kind},
                  {"runs", f.runs},
                  {"goals_reached", f.goals},
                  {"safe_stops", f.safe_stops},
                  {"lost", f.lost},
                  {"replans_mean", mean(static_cast<double>(f.replans), f.runs)},
                  {"replans_max", f.worst_replans},
                  {"decision_mean_ms", mean(f.decision_ms_sum, f.incidents)}};
    if (kind == "all") {
      document.update(entry);
    } else {
      document["classes"].push_back(std::move(entry));
    }
  }
  document["lost_seeds"] = json::array();
  for (const LineRun& run : figures.lost)
    document["lost_seeds"].push_back({{"seed", run.seed}, {"story", run.story}, {"why", run.why}});
  return document.dump(2);
}

}  // namespace stepwright::campaign
