#include <gtest/gtest.h>

#include "tests/unit/plant_models/assemblies/bench_rig.h"

namespace stepwright::assemblies {
namespace {

constexpr double kLevelPercent = 10.0;         // one plan level
constexpr double kSupplierShare = 3.0 / 20.0;  // percent of f1 per percent of another tank

TEST(TankBenchLiquid, WhenMade_ThenLevelsAreThoseOfTheProblem) {
  const BenchRig rig;
  EXPECT_DOUBLE_EQ(rig.truth("level_v1_percent"), 20.0);
  EXPECT_DOUBLE_EQ(rig.truth("level_a1_percent"), 20.0);
  EXPECT_DOUBLE_EQ(rig.truth("level_a2_percent"), 20.0);
  EXPECT_EQ(rig.sensor("S1"), 1322);
  EXPECT_EQ(rig.sensor("S2"), 736);
  EXPECT_EQ(rig.sensor("S3"), 1061);
}

// Load, carry to a1, unload, let the customer draw, return: what the paper's bench does.
TEST(TankBenchLiquid, WhenOperatedByHand_ThenEveryStepMovesItsLiquid) {
  BenchRig rig;
  rig.pump("B1", 5.0);
  const double loaded = rig.truth("level_v1_percent");
  EXPECT_GT(loaded, 50.0);
  EXPECT_LT(rig.truth("level_f1_percent"), 55.0 - (loaded - 20.0) * kSupplierShare + 1e-6);
  rig.drive("drive_left", "fc2");
  EXPECT_DOUBLE_EQ(rig.truth("level_v1_percent"), loaded);
  rig.pump("B2", 3.0);
  const double unloaded = loaded - rig.truth("level_v1_percent");
  EXPECT_GT(unloaded, 2.0 * kLevelPercent);
  EXPECT_NEAR(rig.truth("level_a1_percent"), 20.0 + unloaded, 1e-9);
  EXPECT_DOUBLE_EQ(rig.truth("level_a2_percent"), 20.0);
  const double supplier = rig.truth("level_f1_percent");
  rig.pump("B3", 5.0);
  const double drawn = rig.truth("delivered_c1_percent");
  EXPECT_GT(drawn, kLevelPercent);
  EXPECT_NEAR(rig.truth("level_a1_percent"), 20.0 + unloaded - drawn, 1e-9);
  EXPECT_NEAR(rig.truth("level_f1_percent"), supplier + drawn * kSupplierShare, 1e-9);
  rig.drive("drive_right", "fc1");
  EXPECT_EQ(rig.truth("sump"), 0.0);
  EXPECT_NEAR(rig.truth("total_liquid"), 12.8, 1e-9);
}

TEST(TankBenchLiquid, WhenVehicleIsAway_ThenTheLoadingPumpMovesNothing) {
  BenchRig rig;
  rig.drive("drive_left", "fc2");
  rig.pump("B1", 5.0);
  EXPECT_DOUBLE_EQ(rig.truth("level_v1_percent"), 20.0);
  EXPECT_DOUBLE_EQ(rig.truth("level_f1_percent"), 55.0);
}

TEST(TankBenchLiquid, WhenVehicleLeavesWhileLoading_ThenTheFlowEndsAtTheSwitch) {
  BenchRig rig;
  rig.set("B1", true);
  rig.run(2.0);
  EXPECT_GT(rig.truth("flow_b1"), 0.2);
  rig.set("drive_left", true);
  rig.run_until([&] { return rig.sensor("fc1") == 0; });
  EXPECT_EQ(rig.truth("flow_b1"), 0.0);
  const double level = rig.truth("level_v1_percent");
  rig.run(1.0);
  EXPECT_DOUBLE_EQ(rig.truth("level_v1_percent"), level);
}

TEST(TankBenchLiquid, WhenUnloadedBetweenPlaces_ThenItSpillsToTheSumpAndIsAccounted) {
  BenchRig rig;
  rig.set("drive_left", true);
  rig.run(2.0);
  rig.set("drive_left", false);
  rig.pump("B2", 1.0);
  EXPECT_GT(rig.truth("sump"), 0.1);
  EXPECT_DOUBLE_EQ(rig.truth("level_a1_percent"), 20.0);
  EXPECT_NEAR(rig.truth("total_liquid"), 12.8, 1e-9);
}

TEST(TankBenchLiquid, WhenSourceRunsEmpty_ThenFlowEndsAndLevelIsNeverNegative) {
  BenchRig rig;
  rig.set("B3", true);
  for (int i = 0; i < 60; ++i) {
    rig.run(0.5);
    ASSERT_GE(rig.truth("level_a1_percent"), -1e-3);  // the solver's tolerance
    ASSERT_GE(rig.truth("flow_b3"), 0.0);
  }
  EXPECT_NEAR(rig.truth("level_a1_percent"), 0.0, 1e-3);
  EXPECT_NEAR(rig.truth("flow_b3"), 0.0, 1e-5);
  EXPECT_NEAR(rig.truth("delivered_c1_percent"), 20.0, 1e-3);
}

TEST(TankBenchLiquid, WhenTargetIsFull_ThenTheRestReturnsToTheSupplier) {
  BenchRig rig;
  rig.set("B1", true);
  rig.run(30.0);
  EXPECT_GT(rig.truth("level_v1_percent"), 100.0);
  EXPECT_LT(rig.truth("level_v1_percent"), 101.0);
  EXPECT_NEAR(rig.truth("overflow_v1"), rig.truth("flow_b1"), 1e-4);
  EXPECT_NEAR(rig.truth("total_liquid"), 12.8, 1e-9);
  EXPECT_EQ(rig.truth("sump"), 0.0);
}

TEST(TankBenchLiquid, WhenHeadGrows_ThenFlowFalls) {
  BenchRig rig;
  rig.set("B1", true);
  rig.run(1.5);
  const double early = rig.truth("flow_b1");
  rig.run_until([&] { return rig.truth("level_v1_percent") > 95.0; });
  EXPECT_LT(rig.truth("flow_b1"), early * 0.9);
  EXPECT_GT(rig.truth("flow_b1"), early * 0.6);
}

TEST(TankBenchLiquid, WhenSwitchedOn_ThenPumpSpinsUpWithItsTimeConstant) {
  BenchRig rig;
  rig.set("B3", true);
  rig.run(0.25);
  EXPECT_NEAR(rig.truth("speed_b3"), 1.0 - 0.36788, 1e-4);
}

}  // namespace
}  // namespace stepwright::assemblies
