// Replans that take over from the running plan instead of stopping it.

#include <gtest/gtest.h>

#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using support::SimulatedController;

ExecutiveOptions changed_demand() {
  ExecutiveOptions options;
  options.goal_changes = {{20.0, "(demand c1)", 8.0}};
  return options;
}

TEST(ExecutiveChange, WhenReplanned_ThenThePlantIsNeverWithoutAProgramUntilTheGoal) {
  SimulatedController controller({});
  const run::RunRecord record = run_bench(controller, changed_demand());
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_EQ(record.replans.size(), 1u) << story(record);
  // The observer takes over from the plan, and the new plan from the observer.
  EXPECT_EQ(controller.changes(), 2);
  // The first plan replaces the first observer; the end of the run is the other stop.
  EXPECT_EQ(controller.stops(), 2);
  EXPECT_FALSE(controller.any_output());
}

TEST(ExecutiveChange, WhenNothingGoesWrong_ThenNothingIsChanged) {
  SimulatedController controller({});
  EXPECT_EQ(run_bench(controller).phase, run::Phase::Done);
  EXPECT_EQ(controller.changes(), 0);
}

TEST(ExecutiveChange, WhenTheRuntimeRefusesChanges_ThenThePlanIsReplacedAsBefore) {
  SimulatedController controller({});
  controller.refuse_changes();
  const run::RunRecord record = run_bench(controller, changed_demand());
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  EXPECT_EQ(record.replans.size(), 1u) << story(record);
  EXPECT_EQ(controller.changes(), 0);
  EXPECT_NEAR(controller.plant_value("level_a1_percent"), 50.0, 2.0);
}

// At the moment of the change everything that the old plan drove is off, and only what the new one wants
// comes on: no pump outlives its plan.
TEST(ExecutiveChange, WhenAnActionIsInterrupted_ThenItsOutputIsOffBeforeTheNextScan) {
  SimulatedController controller({}, {{8.0, "stuck_fc1", 0.0}});
  int seen = 0;
  controller.on_change = [&](std::span<const std::byte> outputs) {
    ++seen;
    EXPECT_TRUE(std::all_of(outputs.begin(), outputs.end(), [](std::byte b) { return b == std::byte{0}; }));
  };
  const run::RunRecord record = run_bench(controller);
  EXPECT_FALSE(record.replans.empty()) << story(record);
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace stepwright::executive
