#include "cell/campaign/cell_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <system_error>
#include <utility>

#include "cell/campaign/printed.h"
#include "cell/campaign/run_observer.h"
#include "cell/campaign/true_goals.h"
#include "cell/missions/mission_kinds.h"
#include "cell/missions/planning/table/planning_table.h"
#include "cell/missions/watched_tags.h"
#include "cell/program/compile_cell.h"
#include "cell/runtime/cell_io.h"
#include "cell/runtime/host_options.h"
#include "runtime/ground/result/value_or_throw.h"

namespace stepwright::campaign {
namespace {

using simulation::PlantFault;
using simulation::SimulatedController;

constexpr const char* kPlantLost = "plant lost";
constexpr double kMostPlant_s = 24.0 * 3'600.0;  // a mission that goes on longer hangs

// As fast as the machine allows, with nobody who would have to start or to see to something.
std::vector<std::string> campaign_overrides(const config::CellConfig& config,
                                            const std::vector<std::string>& own) {
  std::vector<std::string> overrides = {"clock.mode=simulated"};
  if (config.mission.table) {
    const auto unattended = config.mission.table->unattended();
    overrides.insert(overrides.end(), unattended.begin(), unattended.end());
    overrides.emplace_back("executive.start=auto");
  }
  overrides.insert(overrides.end(), own.begin(), own.end());
  overrides.emplace_back("clock.speed=0");
  return overrides;
}

// The files of one run; gone with this.
class StateFolder {
 public:
  StateFolder(const std::filesystem::path& states, std::uint64_t seed)
      : path_(states / ("run-" + std::to_string(seed))) {
    std::filesystem::create_directories(path_);
  }
  StateFolder(const StateFolder&) = delete;
  StateFolder& operator=(const StateFolder&) = delete;
  ~StateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// What the cell's own file schedules, and what the campaign does.
std::vector<PlantFault> faults_of(const config::CellConfig& config, const Disturbance& disturbance) {
  std::vector<PlantFault> faults = disturbance.schedule();
  for (const config::ScheduledFault& each : config.faults)
    if (!config::is_goal_change(each)) faults.push_back({each.at_s, each.name, each.value});
  return faults;
}

// The plant has not begun: it is lost before anything has run.
struct PlantRefusal {
  std::string why;
  std::string printed;
};

// One cell with its controller in this thread.
class Trial {
 public:
  Trial(const CellBase& base, std::uint64_t seed, const Disturbance& disturbance)
      : base_(base),
        folder_(base.cell.states, seed),
        config_(read(seed)),
        controller_(plant_of(config_), cell_runtime::plant_wires(config_),
                    {config_.image.input_bytes, config_.image.output_bytes}, faults_of(config_, disturbance),
                    host_of(config_)),
        observer_(config_) {
    run_.seed = seed;
    run_.disturbance = disturbance;
    controller_.most_s = kMostPlant_s;
    controller_.on_scan = [this](std::span<const std::byte> image) { observer_.look(controller_, image); };
    controller_.on_refused = [this](const PlantFault& fault, const std::string&) {
      run_.refused.push_back(fault.name);
    };
  }

  CellRun run() {
    if (base_.planned)
      run_mission();
    else
      run_program();
    judge_plant();
    judge_constraints();
    run_.time_s = controller_.now_s();
    if (const auto status = controller_.status()) run_.trace_hash = status->trace_hash;
    for (const Sighting& alarm : observer_.alarms()) {
      if (std::ranges::find(run_.alarms, alarm.name) == run_.alarms.end()) run_.alarms.push_back(alarm.name);
    }
    return std::move(run_);
  }

 private:
  config::CellConfig read(std::uint64_t seed) const {
    std::vector<std::string> overrides = base_.overrides;
    overrides.push_back("plant.seed=" + std::to_string(seed));
    overrides.push_back("cell.state_dir=\"" + folder_.path().string() + "\"");
    config::CellConfig config = result::value_or_throw(config::load_cell_config(base_.cell.file, overrides));
    config.plant.log = folder_.path() / "plant.log";
    return config;
  }
  static std::unique_ptr<core::Plant> plant_of(const config::CellConfig& config) {
    auto plant = cell_runtime::fresh_plant(config);
    if (plant) return std::move(*plant);
    throw PlantRefusal{result::to_string(plant.error()), last_lines(config.plant.log)};
  }
  static host::HostConfig host_of(const config::CellConfig& config) {
    host::HostConfig host = result::value_or_throw(cell_runtime::host_options(config));
    host.faults.clear();  // the controller injects them
    host.retain = {};
    return host;
  }

  void run_mission() {
    const auto planner = result::value_or_throw(missions::open(config_));
    const auto mission = planner->mission(controller_, {});
    mission->watch(missions::watched_tags(config_));
    mission->only_once();
    const run::RunRecord record = mission->run();
    run_.replans = record.replans.size();
    judge_mission(record);
  }

  void judge_mission(const run::RunRecord& record) {
    run_.why = wrong_end(record, controller_);
    if (!run_.why.empty()) {
      run_.cause = "end";
      return;
    }
    if (record.phase == run::Phase::Done) {
      run_.why = goal_missed(record);
      run_.cause = run_.why.empty() ? "" : "goal";
      if (run_.why.empty()) run_.verdict = Verdict::GoalReached;
      return;
    }
    run_.why = wrong_stop(record);
    run_.cause = record.incidents.empty() ? "end" : to_string(record.incidents.back().kind);
    if (run_.why.empty()) run_.why = needless_stop(record);
    if (!run_.why.empty()) return;
    run_.verdict = Verdict::SafeStop;
    run_.why = record.message;
  }

  std::string goal_missed(const run::RunRecord& record) const {
    for (const run::GoalRecord& goal : record.goal)
      if (!goal.met) return "the report itself says that " + goal.text + " is not met";
    const auto* const table = missions::table_as<missions::PlanningTable>(config_.mission.table);
    if (table == nullptr) return {};
    const auto binding = translate::load_binding(table->binding);
    if (!binding) return result::to_string(binding.error());
    return wrong_goal(record, *binding, cell_runtime::plant_wires(config_), controller_.plant(),
                      !run_.disturbance.faults.empty());
  }

  // What began only after the stop, or was not taken, is no cause of it.
  std::string needless_stop(const run::RunRecord& record) const {
    const auto before = [&](const DrawnFault& fault) {
      return fault.at_s <= controller_.now_s() &&
             std::ranges::find(run_.refused, fault.name) == run_.refused.end();
    };
    if (!config_.faults.empty() || std::ranges::any_of(run_.disturbance.faults, before)) return {};
    return "stopped although nothing was wrong: " + record.message;
  }

  void run_program() {
    result::value_or_throw(controller_.download(base_.program));
    if (auto started = controller_.start(false); !started)
      throw std::runtime_error(result::to_string(started.error()));
    while (controller_.now_s() < base_.cell.seconds && controller_.running()) controller_.scan_once();
    if (!controller_.running()) {
      run_.cause = "trap";
      run_.why = fmt::format("the program stopped at {:.2f} s", controller_.now_s());
      return;
    }
    (void)controller_.stop("the campaign's time is over");
    run_.verdict = Verdict::GoalReached;
  }

  // A program that stops with its plant has done nothing wrong, and how it would have gone nobody knows.
  void judge_plant() {
    const std::string trouble =
        run_.verdict == Verdict::GoalReached ? std::string() : controller_.plant_trouble();
    if (trouble.empty()) return;
    run_.verdict = Verdict::Lost;
    run_.cause = kPlantLost;
    run_.why = trouble;
    run_.printed = last_lines(config_.plant.log);
  }

  // Whatever the end is like.
  void judge_constraints() {
    if (const std::string seen = controller_.plant().violation(); !seen.empty()) {
      run_.verdict = Verdict::Violated;
      run_.cause = "plant";
      run_.why = seen;
    }
    if (!observer_.failed_monitors().empty()) {
      const Sighting& first = observer_.failed_monitors().front();
      run_.verdict = Verdict::Violated;
      run_.cause = "monitor " + first.name;
      run_.why = fmt::format("monitor '{}' failed at {:.2f} s", first.name, first.at_s);
    }
  }

  const CellBase& base_;
  StateFolder folder_;
  config::CellConfig config_;
  SimulatedController controller_;
  RunObserver observer_;
  CellRun run_;
};

}  // namespace

result::Result<CellBase> prepare(const CampaignCell& cell) {
  auto as_it_is = config::load_cell_config(cell.file, cell.overrides);
  if (!as_it_is) return result::forward(as_it_is);
  CellBase base{cell, campaign_overrides(*as_it_is, cell.overrides), {}};
  auto config = config::load_cell_config(cell.file, base.overrides);
  if (!config) return result::forward(config);
  if (config->controller.remote())
    return result::fail("M0041", config->controller.where, "this cell's program runs on a controller",
                        "a campaign is for simulated cells");
  base.planned = config->mission.table != nullptr;
  if (!base.planned && config->boot.sources.empty())
    return result::fail("M0041", {cell.file.string(), 0, 0}, "this cell has neither a planner nor a program",
                        "[planning], or [runtime] sources = [\"main.st\"]");
  config->state_dir = cell.states;
  auto plant = cell_runtime::fresh_plant(*config);
  if (!plant) return result::forward(plant);
  base.offered = offered_faults(**plant);
  base.without_range = (*plant)->faults().size() - base.offered.size();
  if (base.planned) {
    if (auto planner = missions::open(*config); !planner) return result::forward(planner);
    return base;
  }
  result::Diagnostics problems;
  auto program = cell_program::compile_cell(*config, problems);
  if (!program) return tl::unexpected(std::move(problems));
  base.program = std::move(*program);
  return base;
}

CellRun run_cell(const CellBase& base, std::uint64_t seed, const Disturbance& disturbance) {
  CellRun run;
  run.seed = seed;
  run.disturbance = disturbance;
  try {
    return Trial(base, seed, disturbance).run();
  } catch (const PlantRefusal& refusal) {
    run.cause = kPlantLost;
    run.why = refusal.why;
    run.printed = refusal.printed;
  } catch (const std::exception& problem) {  // a run that hangs, or a cell that cannot be made any more
    run.cause = "end";
    run.why = problem.what();
  }
  return run;
}

}  // namespace stepwright::campaign
