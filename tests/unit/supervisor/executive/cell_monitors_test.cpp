// Monitors of the cell in a planned program: what a failed one means for the run.

#include <gtest/gtest.h>

#include "cell/monitors/cell_monitors.h"
#include "runtime/bytecode/reader/program_info.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/translate/monitors.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using support::SimulatedController;

// The vehicle must not drive to the right for two seconds: no plan does without.
config::CellConfig never_far() {
  config::CellConfig config;
  config::MonitorConfig monitor;
  monitor.name = "never_far";
  monitor.formula = "never driving for T#2s";
  monitor.let = {{"driving", "drive_right", {}}};
  config.monitors.push_back(monitor);
  return config;
}

run::RunRecord run_watched(SimulatedController& controller, const config::CellConfig& config, bool told) {
  const auto monitors = cell_monitors::cell_monitors(config);
  EXPECT_TRUE(monitors) << result::to_string(monitors.error());
  PlanningOptions options = bench_planning_options();
  options.watchers = cell_monitors::watchers_of(*monitors);
  const auto planning = PlanningService::open(options);
  EXPECT_TRUE(planning) << result::to_string(planning.error());
  ExecutiveOptions run;
  run.cell = "bench";
  run.max_replans = 1;
  Executive executive(*planning, controller, run, {});
  if (told) executive.watch({{cell_monitors::failed_tag("never_far"), "monitor 'never_far' failed"}});
  return executive.run();
}

TEST(ExecutiveCellMonitors, WhenOneFailsWithEveryPlan_ThenPlansAreMadeUntilTheyAreTooMany) {
  SimulatedController controller(exact_bench());
  const run::RunRecord record = run_watched(controller, never_far(), true);
  EXPECT_EQ(record.phase, run::Phase::Safe) << story(record);
  ASSERT_EQ(record.incidents.size(), 2u) << story(record);
  for (const run::Incident& each : record.incidents) {
    EXPECT_EQ(each.kind, run::IncidentKind::Monitor);
    EXPECT_EQ(each.evidence.front(), "monitor 'never_far' failed");
  }
  EXPECT_EQ(record.incidents[1].response, run::Response::SafeStop);
  EXPECT_EQ(record.replans.size(), 1u);
  EXPECT_FALSE(controller.any_output());
}

TEST(ExecutiveCellMonitors, WhenTheSupervisorIsNotTold_ThenThePlanGoesOn) {
  SimulatedController controller(exact_bench());
  const run::RunRecord record = run_watched(controller, never_far(), false);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  EXPECT_TRUE(record.incidents.empty());
}

TEST(ExecutiveCellMonitors, WhenOneStopsTheScan_ThenTheRunIsGivenUpAndTheTrapNamesIt) {
  config::CellConfig config = never_far();
  config.monitors[0].safe_state = true;
  SimulatedController controller(exact_bench());
  const run::RunRecord record = run_watched(controller, config, true);
  EXPECT_EQ(record.phase, run::Phase::Safe) << story(record);
  EXPECT_EQ(record.incidents.back().kind, run::IncidentKind::Monitor) << record.message;
  EXPECT_NE(record.message.find("monitor 'never_far' failed; the program trapped"), std::string::npos)
      << record.message;
  EXPECT_FALSE(controller.any_output());
}

// What a monitor reads is there while only the sensors are read, or it is not.
TEST(ExecutiveCellMonitors, WhenThePlantIsOnlyLookedAt_ThenMonitorsAreThereThatReadNothingOfAPlan) {
  config::CellConfig config = never_far();
  config::MonitorConfig few;
  few.name = "few_alarms";
  few.formula = "never many";
  few.let = {{"many", std::string(translate::kAlarmCount) + " > 100", {}}};
  config.monitors.push_back(few);
  const auto monitors = cell_monitors::cell_monitors(config);
  ASSERT_TRUE(monitors) << result::to_string(monitors.error());
  PlanningOptions options = bench_planning_options();
  options.watchers = cell_monitors::watchers_of(*monitors);
  const auto planning = PlanningService::open(options);
  ASSERT_TRUE(planning) << result::to_string(planning.error());
  const auto has = [](const PreparedPlan& prepared, const std::string& monitor) {
    const auto info = reader::ProgramInfo::read(prepared.container);
    return info && info->find(cell_monitors::failed_tag(monitor)) != nullptr;
  };
  for (const bool locate : {false, true}) {
    const auto look = planning->observer(locate, std::chrono::milliseconds(1'000));
    ASSERT_TRUE(look) << result::to_string(look.error());
    EXPECT_TRUE(has(*look, "never_far"));
    EXPECT_FALSE(has(*look, "few_alarms"));
  }
  const auto plan = planning->prepare({.start = {.planning = pddl::to_named(planning->task().initial())}});
  ASSERT_TRUE(plan) << result::to_string(plan.error());
  EXPECT_TRUE(has(plan->prepared, "never_far"));
  EXPECT_TRUE(has(plan->prepared, "few_alarms"));
}

}  // namespace
}  // namespace stepwright::executive
