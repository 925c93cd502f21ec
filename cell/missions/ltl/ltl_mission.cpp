// The cell of a tugger train ([ltl]).

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cell/missions/ltl/table/ltl_table.h"
#include "cell/missions/ltl/train_of_plant.h"
#include "cell/missions/ltl/train_wires.h"
#include "cell/missions/mission_kinds.h"
#include "cell/monitors/cell_monitors.h"
#include "runtime/ground/files/files.h"
#include "supervisor/ltl/mission/train_mission.h"
#include "supervisor/ltl/scene/problem_reader.h"

namespace stepwright::missions {
namespace {

const LtlTable& ltl_table(const config::CellConfig& config) {
  return *table_as<LtlTable>(config.mission.table);
}

result::Result<ltl::Problem> read_problem(const config::CellConfig& config) {
  const LtlTable& table = ltl_table(config);
  const auto text = files::read_file(table.problem.string());
  if (!text) return tl::unexpected(text.error());
  auto problem = ltl::read_planning_problem(*text, table.problem, train_of(config.plant));
  if (!problem) return problem;
  if (!table.task.empty()) problem->task = table.task;
  if (auto good = check_agrees(config.plant, problem->train); !good) return result::forward(good);
  keep_within(config.plant, problem->train);
  return problem;
}

// What is asked for at given times; a name that means nothing is X0003, a wrong task at its own code.
result::Result<std::vector<ltl::TimedTrainRequest>> requests_of(const LtlTable& table,
                                                                const ltl::TrainPlanning& planning) {
  std::vector<ltl::TimedTrainRequest> requests;
  result::Diagnostics wrong;
  const auto& places = planning.options().problem.floor.propositions;
  for (const LtlAsked& asked : table.requests) {
    const auto place = std::ranges::find(places, asked.name, &ltl::Area::name);
    if (!asked.name.empty() && place == places.end()) {
      wrong.push_back({"X0003", result::Severity::Error, asked.where,
                       "the floor has no place '" + asked.name + "'", "places are those of the scene"});
      continue;
    }
    if (asked.request == "goal") {
      if (auto good = planning.task(asked.goal); !good) {
        for (result::Diagnostic each : good.error()) {
          each.where = asked.where;
          wrong.push_back(std::move(each));
        }
      }
      requests.push_back({asked.at_s, ltl::GoalChange{asked.goal}});
    }
    if (asked.request == "block") requests.push_back({asked.at_s, ltl::BlockChange{*place}});
    if (asked.request == "unblock") requests.push_back({asked.at_s, ltl::UnblockChange{asked.name}});
    if (asked.request == "hold") requests.push_back({asked.at_s, ltl::HoldChange{}});
    if (asked.request == "resume") requests.push_back({asked.at_s, ltl::ResumeChange{}});
  }
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  std::ranges::stable_sort(requests, {}, &ltl::TimedTrainRequest::at_s);
  return requests;
}

class LtlPlanner final : public CellPlanner {
 public:
  LtlPlanner(config::CellConfig config, ltl::TrainPlanning planning,
             std::vector<ltl::TimedTrainRequest> requests)
      : config_(std::move(config)), planning_(std::move(planning)), requests_(std::move(requests)) {}

  std::unique_ptr<run::Mission> mission(run::Controller& controller,
                                        run::Mission::Observer observer) override {
    const run::MissionOptions options = mission_options(config_);
    return std::make_unique<ltl::TrainMission>(
        planning_, controller,
        ltl::TrainMissionOptions{.cell = options.cell,
                                 .max_replans = config_.executive.max_replans,
                                 .operator_starts = options.operator_starts,
                                 .barrier = options.barrier,
                                 .attended = ltl_table(config_).attended,
                                 .hold = ltl_table(config_).hold,
                                 .journal = config_.journal_path(),
                                 .requests = requests_},
        std::move(observer));
  }

  result::Result<FirstPlan> first_plan() override {
    const ltl::Problem& problem = planning_.options().problem;
    const ltl::TrainTask& task = planning_.first_task();
    auto prepared = planning_.plan({.task = &task,
                                    .state = task.begins(),
                                    .standing = problem.standing(),
                                    .trailers = problem.train.trailers});
    if (!prepared) {
      const std::string& code = prepared.error().front().code;
      if (code != ltl::kImpossible && code != ltl::kNoPlan) return result::forward(prepared);
      return FirstPlan{
          .no_plan = result::to_string(prepared.error()),
          .exit = code == ltl::kImpossible ? result::ExitCode::NoPlan : result::ExitCode::BudgetExhausted};
    }
    FirstPlan first;
    first.cost = prepared->way.end_m;
    first.actions = static_cast<std::size_t>(
        std::ranges::count(prepared->program.steps, ltl::TrainStepKind::Drive, &ltl::TrainStep::kind));
    first.program = std::move(prepared->container);
    return first;
  }

 private:
  const config::CellConfig config_;
  const ltl::TrainPlanning planning_;
  const std::vector<ltl::TimedTrainRequest> requests_;
};

}  // namespace

result::Result<std::unique_ptr<CellPlanner>> open_ltl(const config::CellConfig& config) {
  const LtlTable& table = ltl_table(config);
  auto problem = read_problem(config);
  if (!problem) return result::forward(problem);
  auto terminals = terminals_of(config, *problem);
  if (!terminals) return result::forward(terminals);
  ltl::TrainPlanningOptions options{.problem = *std::move(problem),
                                    .margin_m = table.margin_m,
                                    .terminals = *std::move(terminals),
                                    .program = {},
                                    .seed = table.seed,
                                    .most_s = table.time_s,
                                    .threads = table.threads};
  options.program.interval_us = config.clock.interval_us;
  options.program.drive = drive_of(config.plant, table.top_speed_m_s);
  auto monitors = cell_monitors::cell_monitors(config);
  if (!monitors) return result::forward(monitors);
  options.watchers = cell_monitors::watchers_of(*monitors);
  auto planning = ltl::TrainPlanning::open(std::move(options));
  if (!planning) return result::forward(planning);
  auto requests = requests_of(table, *planning);
  if (!requests) return result::forward(requests);
  return std::make_unique<LtlPlanner>(config, *std::move(planning), *std::move(requests));
}

}  // namespace stepwright::missions
