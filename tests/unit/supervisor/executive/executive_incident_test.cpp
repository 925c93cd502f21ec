// What happens is classified with its evidence, decided and timed; news overtakes a planning under way.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/temporary_folder.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using support::PlantFault;
using support::SimulatedController;

struct Case {
  const char* name;
  PlantFault fault;
  run::IncidentKind kind;
};

class IncidentTest : public testing::TestWithParam<Case> {};

TEST_P(IncidentTest, WhenItHappens_ThenItIsClassifiedAndDecided) {
  SimulatedController controller({}, {GetParam().fault});
  const run::RunRecord record = run_bench(controller);
  ASSERT_FALSE(record.incidents.empty()) << story(record);
  const run::Incident& first = record.incidents.front();
  EXPECT_EQ(first.kind, GetParam().kind) << to_string(first.kind) << ": " << run::sentence_of(first.evidence);
  EXPECT_FALSE(first.evidence.empty());
  for (const run::Incident& incident : record.incidents) {
    EXPECT_NE(incident.response, run::Response::Open);
    EXPECT_GE(incident.decision_ms, 0.0);
  }
  EXPECT_EQ(record.phase == run::Phase::Safe, record.incidents.back().response == run::Response::SafeStop)
      << story(record);
  EXPECT_FALSE(controller.any_output());
}

INSTANTIATE_TEST_SUITE_P(
    Bench, IncidentTest,
    testing::Values(Case{"DeadPump", {0.0, "weak_b3", 0.0}, run::IncidentKind::FailedActuator},
                    Case{"SlowPump", {0.0, "weak_b3", 0.2}, run::IncidentKind::Timeout},
                    Case{"LostPlace", {8.0, "stuck_fc1", 0.0}, run::IncidentKind::Position},
                    Case{"TwoPlaces", {5.0, "stuck_fc2", 1.0}, run::IncidentKind::FailedSensor},
                    Case{"RisingSensor", {10.0, "drift_s2", 40.0}, run::IncidentKind::FailedSensor},
                    Case{"FrozenSensor", {8.5, "frozen_s1", 1.0}, run::IncidentKind::FailedSensor},
                    Case{"Leak", {20.0, "leak_a1", 0.5}, run::IncidentKind::Level}),
    [](const auto& each) { return std::string(each.param.name); });

// S3 shows 237 counts a unit: this is four units a second.
constexpr double kLeap = 1'000.0;

// No program acts while the plant is observed: what a sensor leaps to then would be where the plan begins.
TEST(ExecutiveIncident, WhenASensorLeapsWhileThePlantIsObserved_ThenNothingIsPlannedOnIt) {
  const support::TemporaryFolder folder;
  const PlanningService planning =
      bench_planning_with("must_move = true\n", "must_move = true\nmax_rate = 1\n", folder.path());
  for (const double at_s : {0.3, 0.9, 2.5, 21.0}) {
    SimulatedController controller(exact_bench(), {{at_s, "drift_s3", kLeap}});
    ExecutiveOptions options;
    options.goal_changes = {{20.0, "(demand c1)", 8.0}};
    const run::RunRecord record = run_bench(controller, options, planning);
    EXPECT_EQ(record.phase, run::Phase::Safe) << story(record);
    ASSERT_FALSE(record.incidents.empty());
    const run::Incident& last = record.incidents.back();
    EXPECT_EQ(last.kind, run::IncidentKind::FailedSensor) << at_s;
    EXPECT_EQ(last.evidence.back(), "sensor S3 leaps: no plant changes so fast") << at_s;
    EXPECT_EQ(record.episodes.empty(), at_s < 20.0) << story(record);
    EXPECT_FALSE(controller.any_output());
  }
}

TEST(ExecutiveIncident, WhenAClientChangesItsDemand_ThenItIsARepairOrANewPlanAndBothAreTimed) {
  SimulatedController controller({});
  ExecutiveOptions options;
  options.goal_changes = {{20.0, "(demand c1)", 8.0}};
  const run::RunRecord record = run_bench(controller, options);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_EQ(record.incidents.size(), 1u);
  const run::Incident& incident = record.incidents[0];
  EXPECT_EQ(incident.kind, run::IncidentKind::ChangedDemand);
  EXPECT_GT(incident.decision_ms, 0.0);
  EXPECT_GT(incident.remaining, 0u);
  EXPECT_GT(incident.repair_ms, 0.0);
  EXPECT_EQ(record.episodes.back().remaining, incident.remaining);
}

TEST(ExecutiveIncident, WhenANewGoalIsWanted_ThenItIsReached) {
  SimulatedController controller({});
  ExecutiveOptions options;
  options.goal_changes = {{15.0, "", 0.0, "(and (is-at v1 a2) (= (level a1) 4) (= (level a2) 3))"}};
  const run::RunRecord record = run_bench(controller, options);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_EQ(record.incidents.size(), 1u);
  EXPECT_EQ(record.incidents[0].kind, run::IncidentKind::NewGoal);
  EXPECT_NEAR(controller.plant_value("level_a1_percent"), 40.0, 2.0);
  EXPECT_NEAR(controller.plant_value("level_a2_percent"), 30.0, 2.0);
  EXPECT_NEAR(controller.plant_value("position"), 1.0, 0.05);
}

// A wish that stops a pump between two units: what is left to the next one is drawn, too.
TEST(ExecutiveIncident, WhenANewGoalIsLessThanAUnitAway_ThenItIsReached) {
  SimulatedController controller({});
  ExecutiveOptions options;
  options.goal_changes = {{47.9, "", 0.0, "(and (is-at v1 f1) (= (level a1) 2) (= (level a2) 6))"}};
  const run::RunRecord record = run_bench(controller, options);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_EQ(record.incidents.size(), 1u) << story(record);
  EXPECT_NEAR(controller.plant_value("level_a1_percent"), 20.0, 1.5);
  const std::vector<run::ActionRecord>& actions = record.episodes.back().actions;
  EXPECT_TRUE(std::any_of(actions.begin(), actions.end(), [](const run::ActionRecord& action) {
    return action.text == "(final_order a1 c1 level1)";
  })) << story(record);
}

// The customer's pump was too slow twice, the second time a fraction of a unit before the goal: without it
// nothing lowers a2.
TEST(ExecutiveIncident, WhenNoActionMovesWhatIsLeft_ThenTheSafeStopNamesThePumpAndByHowMuch) {
  assemblies::BenchParameters parameters;
  parameters.seed = 3269;
  SimulatedController controller(parameters, {{66.60, "weak_b4", 0.186}});
  const run::RunRecord record = run_bench(controller);
  ASSERT_EQ(record.phase, run::Phase::Safe) << story(record);
  ASSERT_EQ(record.incidents.size(), 2u) << story(record);
  EXPECT_EQ(record.incidents[1].kind, run::IncidentKind::FailedActuator);
  EXPECT_EQ(record.incidents[1].devices, std::vector<std::string>{"customer pump of a2"});
  EXPECT_NE(record.message.find("without customer pump of a2"), std::string::npos) << record.message;
  EXPECT_NE(record.message.find("less than a plan can mend: level of a2 is 5.2"), std::string::npos)
      << record.message;
}

TEST(ExecutiveIncident, WhenAGoalIsNoGoal_ThenItIsRefused) {
  SimulatedController controller({});
  Executive executive(bench_planning(), controller, {}, {});
  EXPECT_FALSE(executive.request_goal("(= (level a9) 4)"));
  EXPECT_FALSE(executive.request_goal("(and"));
  EXPECT_TRUE(executive.request_goal("(= (level a1) 4)"));
}

// The bench has one pump for each customer and one way to each place: without one of them there is no plan.
TEST(ExecutiveIncident, WhenAPumpHasFailed_ThenTheSafeStopNamesIt) {
  SimulatedController controller({}, {{0.0, "weak_b3", 0.0}});
  const run::RunRecord record = run_bench(controller);
  EXPECT_EQ(record.phase, run::Phase::Safe);
  ASSERT_EQ(record.incidents.size(), 2u) << story(record);
  EXPECT_TRUE(record.incidents[0].devices.empty());
  EXPECT_EQ(record.incidents[1].devices, std::vector<std::string>{"customer pump of a1"});
  EXPECT_NE(record.message.find("there is no plan from the observed state without customer pump of a1"),
            std::string::npos)
      << record.message;
  // The level beyond the goal has no other way out of a1.
  EXPECT_NE(record.message.find("so (= (level a1) 5) and (>= (received c1) (demand c1)) cannot be reached"),
            std::string::npos)
      << record.message;
  EXPECT_NEAR(controller.plant_value("delivered_c1_percent"), 0.0, 1.0);
}

// A switch that somebody has turned for a while: it is told and planned for, and no sensor is blamed.
TEST(ExecutiveIncident, WhenAPumpStandsStillForAWhile_ThenThatIsAnIncidentOfThePumpAndTheGoalIsReached) {
  const support::TemporaryFolder folder;
  const PlanningService planning = bench_planning_without("must_move = true\n", folder.path());
  SimulatedController controller(exact_bench(), {{7.5, "weak_b1", 0.0}, {16.0, "weak_b1", 1.0, true}});
  const run::RunRecord record = run_bench(controller, {}, planning);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_FALSE(record.incidents.empty());
  const run::Incident& first = record.incidents.front();
  EXPECT_EQ(first.kind, run::IncidentKind::FailedActuator) << run::sentence_of(first.evidence);
  EXPECT_LT(first.time_s, 13.5);
  EXPECT_NE(run::sentence_of(first.evidence)
                .find("has stopped halfway: the level of v1 stands still though B1 is on"),
            std::string::npos)
      << run::sentence_of(first.evidence);
}

// One that shows the same for ever ends the run all the same, as what it is: nothing that can be told from a
// pump without effect.
TEST(ExecutiveIncident, WhenASensorWithoutNoiseIsFrozen_ThenTheRunEndsSafely) {
  const support::TemporaryFolder folder;
  const PlanningService planning = bench_planning_without("must_move = true\n", folder.path());
  SimulatedController controller(exact_bench(), {{8.5, "frozen_s1", 1.0}});
  const run::RunRecord record = run_bench(controller, {}, planning);
  EXPECT_EQ(record.phase, run::Phase::Safe) << story(record);
  EXPECT_EQ(record.incidents.front().kind, run::IncidentKind::FailedActuator) << story(record);
}

TEST(ExecutiveIncident, WhenTheRuntimeIsKilled_ThenItIsALostRuntime) {
  SimulatedController controller({});
  controller.kill_runtime_at(20.0);
  const run::RunRecord record = run_bench(controller);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_EQ(record.incidents.size(), 1u);
  EXPECT_EQ(record.incidents[0].kind, run::IncidentKind::LostRuntime);
}

// A wish that comes while a plan is made: that planning is cancelled, and the plan that runs knows the wish.
TEST(ExecutiveIncident, WhenAWishOvertakesAPlanning_ThenItStartsAgain) {
  SimulatedController controller({});
  ExecutiveOptions options;
  options.cell = "bench";
  options.goal_changes = {{20.0, "(demand c1)", 8.0}};
  Executive* running = nullptr;
  int wishes = 0;
  Executive executive(bench_planning(), controller, options, [&](const run::RunRecord& record) {
    if (record.phase != run::Phase::Replanning || wishes++ > 0) return;
    ASSERT_TRUE(running->request_change("(demand c2)", 9.0));
  });
  running = &executive;
  const run::RunRecord record = executive.run();
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_EQ(record.incidents.size(), 1u) << story(record);
  EXPECT_EQ(record.incidents[0].restarts, 1u);
  EXPECT_NE(run::sentence_of(record.incidents[0].evidence).find("(demand c2) was changed to 9"),
            std::string::npos);
  EXPECT_NEAR(controller.plant_value("delivered_c2_percent"), 90.0, 4.0);
}

// An alarm of the monitors is told with the incident that it led to.
TEST(ExecutiveIncident, WhenALevelFallsWhileAnActionRuns_ThenTheAlarmIsInTheReportWithinAScan) {
  SimulatedController controller({}, {{8.0, "leak_a2", 3.0}});
  const run::RunRecord record = run_bench(controller);
  ASSERT_FALSE(record.incidents.empty()) << story(record);
  const run::Incident& first = record.incidents.front();
  ASSERT_FALSE(first.alarms.empty());
  EXPECT_EQ(first.alarms.front().kind, "invariant");
  EXPECT_EQ(first.alarms.front().sensor, "S3");
  EXPECT_LT(first.alarms.front().value, 1.81);
  // 3 percent a second: the tolerance of 2 points is left after 0.7 s and the time of the filter.
  EXPECT_LT(first.time_s, 9.5);
}

}  // namespace
}  // namespace stepwright::executive
