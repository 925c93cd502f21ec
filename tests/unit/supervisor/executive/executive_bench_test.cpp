// The main job without the processes around it: seeds, faults, changed goals.

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using support::PlantFault;
using support::SimulatedController;

TEST(ExecutiveBench, WhenNothingGoesWrong_ThenTheGoalIsReachedWithoutReplanning) {
  assemblies::BenchParameters parameters;
  parameters.seed = 1;
  SimulatedController controller(parameters);
  const run::RunRecord record = run_bench(controller);
  EXPECT_EQ(record.tare.size(), 3u);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  EXPECT_TRUE(record.replans.empty()) << story(record);
  ASSERT_EQ(record.episodes.size(), 1u);
  EXPECT_EQ(record.episodes[0].cost, 108.0);
  EXPECT_TRUE(record.episodes[0].proved_optimal);
  for (const run::ActionRecord& action : record.episodes[0].actions) {
    EXPECT_EQ(action.state, run::ActionState::Done) << action.text;
    EXPECT_TRUE(action.started_s && action.finished_s) << action.text;
  }
  EXPECT_FALSE(controller.any_output());
}

// The paper's end levels were 47/34 and 61/43 percent for a goal of 50/50.
TEST(ExecutiveBench, WhenSensorsAreUncertain_ThenTheLevelsAreWithinTwoPointsForEachOf100Seeds) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    assemblies::BenchParameters parameters;
    parameters.seed = seed;
    SimulatedController controller(parameters);
    const run::RunRecord record = run_bench(controller);
    ASSERT_EQ(record.phase, run::Phase::Done) << "seed " << seed << ": " << story(record);
    EXPECT_TRUE(record.replans.empty()) << "seed " << seed << ": " << story(record);
    EXPECT_NEAR(controller.plant_value("level_a1_percent"), 50.0, 2.0) << "seed " << seed;
    EXPECT_NEAR(controller.plant_value("level_a2_percent"), 50.0, 2.0) << "seed " << seed;
  }
}

TEST(ExecutiveBench, WhenTheSameSeedRunsTwice_ThenTheTracesAreEqual) {
  std::uint64_t hashes[2] = {};
  for (std::uint64_t& hash : hashes) {
    SimulatedController controller({});
    EXPECT_EQ(run_bench(controller).phase, run::Phase::Done);
    hash = controller.status()->trace_hash;
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

struct FaultCase {
  const char* name;
  double value;
  double at_s;
};

class FaultTest : public testing::TestWithParam<FaultCase> {};

// Every fault ends at the goal, or in the safe state with a reason.
TEST_P(FaultTest, WhenItIsInjected_ThenTheRunEndsAtTheGoalOrSafely) {
  const FaultCase& fault = GetParam();
  SimulatedController controller({}, {PlantFault{fault.at_s, fault.name, fault.value}});
  const run::RunRecord record = run_bench(controller);
  SCOPED_TRACE(story(record));
  EXPECT_FALSE(record.episodes.empty());
  EXPECT_FALSE(controller.any_output());
  if (record.phase == run::Phase::Done) {
    EXPECT_TRUE(
        std::all_of(record.goal.begin(), record.goal.end(), [](const run::GoalRecord& g) { return g.met; }));
  } else {
    EXPECT_EQ(record.phase, run::Phase::Safe);
    EXPECT_FALSE(record.message.empty());
  }
  RecordProperty("story", story(record));
}

INSTANTIATE_TEST_SUITE_P(Bench, FaultTest,
                         testing::Values(FaultCase{"leak_a1", 0.3, 30.0}, FaultCase{"leak_a2", 3.0, 20.0},
                                         FaultCase{"leak_v1", 0.3, 10.0}, FaultCase{"weak_b1", 0.5, 0.0},
                                         FaultCase{"weak_b2", 0.3, 15.0}, FaultCase{"weak_b3", 0.0, 0.0},
                                         FaultCase{"stuck_fc1", 0.0, 12.0}, FaultCase{"stuck_fc2", 1.0, 5.0},
                                         FaultCase{"drift_s2", 2.0, 10.0}, FaultCase{"draw_c1", 15.0, 30.0}));

std::string first_cause(const PlanningService& planning, const PlantFault& fault) {
  SimulatedController controller({}, {fault});
  const run::RunRecord record = Executive(planning, controller, {}, {}).run();
  return record.replans.empty() ? story(record) : record.replans.front().cause;
}

void expect_cause(const PlanningService& planning, const PlantFault& fault, const std::string& part) {
  const std::string cause = first_cause(planning, fault);
  EXPECT_NE(cause.find(part), std::string::npos) << cause;
}

// The chart has one FAILED step per action; the cause tells which of its reasons it was.
TEST(ExecutiveBench, WhenAnActionFails_ThenTheCauseTellsTimeoutLostHoldAndRefusedStartApart) {
  PlanningOptions options = bench_planning_options();
  options.monitors = false;  // which would tell of the level before the action is refused
  const auto planning = PlanningService::open(options);
  ASSERT_TRUE(planning);
  expect_cause(*planning, {0.0, "weak_b3", 0.0}, "(complete_order a1 c1 level7) did not end within 60 s");
  expect_cause(*planning, {8.0, "stuck_fc1", 0.0},
               "(load v1 f1 level7) was stopped: 'vehicle at f1' was lost while it ran");
  expect_cause(*planning, {15.5, "leak_v1", 3.0},
               "(unload v1 a1 level7) could not start: its precondition is not observed");
}

TEST(ExecutiveBench, WhenAPlanIsWatched_ThenWhatHasNoEffectAndWhatLeaksIsFoundSooner) {
  expect_cause(bench_planning(), {0.0, "weak_b3", 0.0},
               "(complete_order a1 c1 level7) had no effect in 7.75 s: B3 was on");
  expect_cause(bench_planning(), {0.0, "weak_b3", 0.2},
               "(complete_order a1 c1 level7) did not end within 60 s");
  expect_cause(bench_planning(), {15.5, "leak_v1", 3.0}, "level of v1 is 8.");
}

TEST(ExecutiveBench, WhenAClientChangesItsDemand_ThenTheNewDemandIsMet) {
  SimulatedController controller({});
  ExecutiveOptions options;
  options.goal_changes = {{20.0, "(demand c1)", 8.0}};
  const run::RunRecord record = run_bench(controller, options);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_EQ(record.replans.size(), 1u) << story(record);
  EXPECT_NEAR(controller.plant_value("level_a1_percent"), 50.0, 2.0);
}

TEST(ExecutiveBench, WhenTheRuntimeIsKilled_ThenThePlanGoesOnFromTheObservedState) {
  SimulatedController controller({});
  ExecutiveOptions options;
  options.cell = "bench";
  int published = 0;
  const Executive::Observer kill_once = [&](const run::RunRecord& record) {
    if (record.phase == run::Phase::Executing && ++published == 12) controller.kill_runtime();
  };
  const run::RunRecord record = Executive(bench_planning(), controller, options, kill_once).run();
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  EXPECT_EQ(record.replans.size(), 1u) << story(record);
}

// The journal carries the record's clock: what a restarted supervisor notes comes after what was noted
// before.
TEST(ExecutiveBench, WhenSupervisorAndRuntimeAreRestarted_ThenTheTimeOfTheRecordGoesOn) {
  const std::filesystem::path journal = testing::TempDir() + "resumed_executive.json";
  std::filesystem::remove(journal);
  ExecutiveOptions options;
  options.cell = "bench";
  options.journal = journal;
  const std::filesystem::path kept = testing::TempDir() + "kept_executive.json";
  SimulatedController first({});
  int published = 0;
  Executive(bench_planning(), first, options, [&](const run::RunRecord& record) {
    if (record.phase == run::Phase::Executing && ++published == 12) {
      std::filesystem::copy_file(journal, kept, std::filesystem::copy_options::overwrite_existing);
    }
  }).run();
  options.journal = kept;
  SimulatedController second({});
  Executive* running = nullptr;
  Executive resumed(bench_planning(), second, options, [&](const run::RunRecord& record) {
    if (record.phase == run::Phase::Replanning) running->request_abort();
  });
  running = &resumed;
  const run::RunRecord record = resumed.run();
  ASSERT_EQ(record.replans.size(), 1u) << story(record);
  EXPECT_GT(record.finished_s, 0.0);
  EXPECT_GE(record.replans[0].time_s, record.finished_s);
}

// A monitor raises its alarm once, and it is told once, also by a supervisor that has only read of it.
TEST(ExecutiveBench, WhenASupervisorIsRestarted_ThenAlarmsThatWereToldAreNotToldAgain) {
  struct Killed {};
  const std::filesystem::path journal = testing::TempDir() + "told_alarms.json";
  std::filesystem::remove(journal);
  ExecutiveOptions options;
  options.cell = "bench";
  options.journal = journal;
  SimulatedController controller({}, {{8.0, "leak_a2", 3.0}});
  const auto kill = [](const run::RunRecord& record) {
    if (record.phase == run::Phase::Replanning) throw Killed{};
  };
  EXPECT_THROW(Executive(bench_planning(), controller, options, kill).run(), Killed);
  (void)controller.acknowledge(1'000'000);  // of the news that nobody answers any more
  const run::RunRecord record = Executive(bench_planning(), controller, options, {}).run();
  ASSERT_GE(record.incidents.size(), 3u) << story(record);
  ASSERT_FALSE(record.incidents[0].alarms.empty());
  EXPECT_EQ(record.incidents[1].kind, run::IncidentKind::LostSupervisor);
  const run::Alarm& first = record.incidents[0].alarms[0];
  for (std::size_t i = 1; i < record.incidents.size(); ++i) {
    for (const run::Alarm& alarm : record.incidents[i].alarms) {
      EXPECT_NE(alarm.action + alarm.condition, first.action + first.condition) << i;
    }
  }
}

}  // namespace
}  // namespace stepwright::executive
