// An operator holds a run and lets it go on.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using support::SimulatedController;

constexpr int kHeldScans = 500;

bool runs(const run::RunRecord& record, const std::string& action) {
  if (record.phase != run::Phase::Executing || record.episodes.empty()) return false;
  for (const run::ActionRecord& each : record.episodes.back().actions) {
    if (each.text.starts_with(action) && each.state == run::ActionState::Active) return true;
  }
  return false;
}

// A bench whose operator holds it when `when` says so for the first time, and lets it go on after some
// seconds at rest. What the plant does meanwhile is kept.
struct HeldBench {
  explicit HeldBench(ExecutiveOptions options_in = {}, std::vector<support::PlantFault> faults = {})
      : controller({}, std::move(faults)), options(std::move(options_in)) {
    options.cell = "bench";
    executive.emplace(bench_planning(), controller, options, [this](const run::RunRecord& now) { see(now); });
    controller.on_scan = [this](std::span<const std::byte>) { scan(); };
  }

  void see(const run::RunRecord& now) {
    if (phases.empty() || phases.back() != to_string(now.phase)) phases.emplace_back(to_string(now.phase));
    held = now.phase == run::Phase::Held;
    if (held) held_messages.push_back(now.message);
    if (held && on_held) on_held();
    if (!asked && when && when(now)) {
      asked = true;
      EXPECT_TRUE(executive->request_hold());
    }
  }

  void scan() {
    if (!held) return;
    driven = driven || controller.any_output();
    const double level = controller.plant_value("level_v1_percent");
    if (held_scans == 0) level_before = level;
    level_after = level;
    if (++held_scans < kHeldScans) return;
    on_rested();
    controller.interrupt();
  }

  SimulatedController controller;
  ExecutiveOptions options;
  std::optional<Executive> executive;
  std::function<bool(const run::RunRecord&)> when = [](const run::RunRecord& now) {
    return runs(now, "(load v1");
  };
  std::function<void()> on_held;
  std::function<void()> on_rested = [this] { EXPECT_TRUE(executive->request_resume()); };
  std::vector<std::string> phases;
  std::vector<std::string> held_messages;
  bool asked = false;
  bool held = false;
  bool driven = false;
  int held_scans = 0;
  double level_before = 0.0;
  double level_after = 0.0;
};

TEST(ExecutiveHold, WhenHeldWhileAPumpRuns_ThenThePlantRestsUntilItIsResumedAndReachesTheGoal) {
  ExecutiveOptions options;
  options.max_replans = 0;  // a hold is no fault of the plan
  HeldBench bench(options);
  const run::RunRecord record = bench.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, run::Phase::Done);
  EXPECT_EQ(bench.phases, (std::vector<std::string>{"planning", "observing", "executing", "holding", "held",
                                                    "replanning", "executing", "done"}));
  EXPECT_GE(bench.held_scans, kHeldScans);
  EXPECT_FALSE(bench.driven);
  EXPECT_DOUBLE_EQ(bench.level_before, bench.level_after);
  EXPECT_GT(bench.level_before, 0.0);
  ASSERT_EQ(record.replans.size(), 1u);
  EXPECT_TRUE(record.replans[0].held);
  ASSERT_EQ(record.incidents.size(), 1u);
  EXPECT_EQ(record.incidents[0].kind, run::IncidentKind::Operator);
  EXPECT_EQ(record.incidents[0].evidence.front(), "held by the operator");
  EXPECT_NE(record.incidents[0].evidence.back().find("resumed after"), std::string::npos);
  for (const run::GoalRecord& goal : record.goal) EXPECT_TRUE(goal.met) << goal.text;
}

TEST(ExecutiveHold, WhenAskedTwiceOrWithoutNeed_ThenItIsRefusedWithTheReason) {
  HeldBench bench;
  const auto needless = bench.executive->request_resume();
  ASSERT_FALSE(needless);
  EXPECT_EQ(needless.error().front().code, "X0008");
  std::string second;
  bench.on_held = [&] {
    if (auto again = bench.executive->request_hold(); !again) second = again.error().front().code;
  };
  EXPECT_EQ(bench.executive->run().phase, run::Phase::Done);
  EXPECT_EQ(second, "X0008");
}

TEST(ExecutiveHold, WhenAnotherGoalComesWhileItIsHeld_ThenItSaysThatThePlantRestsAndPlansForItAfterwards) {
  HeldBench bench;
  bool asked = false;
  bench.on_held = [&] {
    if (std::exchange(asked, true)) return;
    EXPECT_TRUE(bench.executive->request_goal("(= (level a1) 4)"));
  };
  const run::RunRecord record = bench.executive->run();
  SCOPED_TRACE(story(record));
  ASSERT_FALSE(bench.held_messages.empty());
  EXPECT_EQ(
      bench.held_messages.back(),
      "the goal was changed to (= (level a1) 4): that is planned for when the run is resumed; until then the "
      "plant rests");
  EXPECT_EQ(record.phase, run::Phase::Done);
}

TEST(ExecutiveHold, WhenAskedBeforeThePlanBegins_ThenNothingMovesUntilItIsResumed) {
  HeldBench bench;
  bench.when = [](const run::RunRecord& now) { return now.phase == run::Phase::Planning; };
  const run::RunRecord record = bench.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, run::Phase::Done);
  EXPECT_EQ(bench.phases, (std::vector<std::string>{"planning", "observing", "holding", "held", "replanning",
                                                    "executing", "done"}));
  EXPECT_FALSE(bench.driven);
  EXPECT_EQ(record.episodes.size(), 1u);
}

TEST(ExecutiveHold, WhenAskedWhileAnotherPlanIsMade_ThenThatPlanWaits) {
  ExecutiveOptions options;
  options.goal_changes = {{20.0, "(demand c1)", 8.0}};
  HeldBench bench(options);
  bench.when = [](const run::RunRecord& now) { return now.phase == run::Phase::Replanning; };
  const run::RunRecord record = bench.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, run::Phase::Done);
  EXPECT_GE(bench.held_scans, kHeldScans);
  EXPECT_FALSE(bench.driven);
  EXPECT_EQ(record.episodes.size(), 2u);
  EXPECT_NEAR(bench.controller.plant_value("level_a1_percent"), 50.0, 2.0);
}

TEST(ExecutiveHold, WhenTheGoalChangesMeanwhile_ThenThePlanAfterItIsForTheNewOne) {
  HeldBench bench;
  bool changed = false;
  bench.on_held = [&] {
    if (std::exchange(changed, true)) return;
    EXPECT_TRUE(bench.executive->request_change("(demand c1)", 8.0));
  };
  const run::RunRecord record = bench.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, run::Phase::Done);
  EXPECT_EQ(record.replans.size(), 1u);
  EXPECT_NEAR(bench.controller.plant_value("level_a1_percent"), 50.0, 2.0);
}

TEST(ExecutiveHold, WhenItIsAborted_ThenTheRunEndsSafely) {
  HeldBench bench;
  bench.on_rested = [&] { bench.executive->request_abort(); };
  const run::RunRecord record = bench.executive->run();
  EXPECT_EQ(record.phase, run::Phase::Safe) << story(record);
  EXPECT_EQ(record.message, "aborted by the operator");
  EXPECT_FALSE(bench.controller.any_output());
}

TEST(ExecutiveHold, WhenTheRuntimeIsLostMeanwhile_ThenItGoesOnFromWhereThePlantIs) {
  HeldBench bench;
  bench.on_rested = [&] {
    EXPECT_TRUE(bench.executive->request_resume());
    bench.controller.kill_runtime();
  };
  const run::RunRecord record = bench.executive->run();
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
}

// Nobody has let it go on.
TEST(ExecutiveHold, WhenTheSupervisorIsRestarted_ThenTheRunIsStillHeld) {
  struct Killed {};
  ExecutiveOptions options;
  options.max_replans = 0;  // nor is the restart one
  options.journal = testing::TempDir() + "held_executive.json";
  std::filesystem::remove(options.journal);
  HeldBench bench(options);
  bench.on_held = [] { throw Killed{}; };
  EXPECT_THROW((void)bench.executive->run(), Killed);
  (void)bench.controller.acknowledge(1'000'000);  // of the news that nobody answers any more
  bench.on_held = {};
  bench.when = {};
  bench.phases.clear();
  bench.executive.emplace(bench_planning(), bench.controller, bench.options,
                          [&](const run::RunRecord& now) { bench.see(now); });
  const run::RunRecord record = bench.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, run::Phase::Done);
  EXPECT_GE(bench.held_scans, kHeldScans);
  EXPECT_FALSE(bench.driven);
  ASSERT_GE(bench.phases.size(), 4u);
  EXPECT_LT(std::ranges::find(bench.phases, "held"), std::ranges::find(bench.phases, "executing"));
  ASSERT_EQ(record.replans.size(), 2u) << "what the first supervisor has noted is kept";
  EXPECT_EQ(record.replans[0].cause, "held by the operator");
  EXPECT_EQ(record.replans[1].cause, "held by the operator; the supervisor was restarted meanwhile");
  for (const run::Replan& each : record.replans) EXPECT_TRUE(each.held) << each.cause;
}

}  // namespace
}  // namespace stepwright::executive
