#include <gtest/gtest.h>

#include "tests/unit/plant_models/assemblies/bench_rig.h"

namespace stepwright::assemblies {
namespace {

TEST(TankBenchFault, WhenTankLeaks_ThenItEmptiesIntoTheSumpAtTheRate) {
  BenchRig rig;
  ASSERT_TRUE(rig.plant().inject_fault("leak_a1", 0.5));
  rig.run(10.0);
  EXPECT_NEAR(rig.truth("level_a1_percent"), 15.0, 1e-6);
  EXPECT_NEAR(rig.truth("sump"), 0.15, 1e-9);
  EXPECT_NEAR(rig.truth("leak"), 0.015, 1e-9);
  ASSERT_TRUE(rig.plant().clear_fault("leak_a1"));
  rig.run(10.0);
  EXPECT_NEAR(rig.truth("level_a1_percent"), 15.0, 1e-6);
  EXPECT_NEAR(rig.truth("total_liquid"), 12.8, 1e-9);
}

TEST(TankBenchFault, WhenPumpIsWeak_ThenItDeliversThatShare) {
  BenchRig healthy, weak;
  ASSERT_TRUE(weak.plant().inject_fault("weak_b1", 0.4));
  for (BenchRig* rig : {&healthy, &weak}) {
    rig->set("B1", true);
    rig->run(1.0);
  }
  EXPECT_NEAR(weak.truth("flow_b1") / healthy.truth("flow_b1"), 0.4, 0.02);
  ASSERT_TRUE(weak.plant().clear_fault("weak_b1"));
  weak.run(0.01);
  EXPECT_GT(weak.truth("flow_b1"), healthy.truth("flow_b1") * 0.98);
}

TEST(TankBenchFault, WhenSwitchIsStuck_ThenItShowsThatAndLiquidStillFollowsThePosition) {
  BenchRig rig;
  ASSERT_TRUE(rig.plant().inject_fault("stuck_fc1", 0));
  ASSERT_TRUE(rig.plant().inject_fault("stuck_fc3", 1));
  EXPECT_EQ(rig.sensor("fc1"), 0);
  EXPECT_EQ(rig.sensor("fc3"), 1);
  rig.pump("B1", 2.0);
  EXPECT_GT(rig.truth("level_v1_percent"), 25.0);
  ASSERT_TRUE(rig.plant().clear_fault("stuck_fc1"));
  EXPECT_EQ(rig.sensor("fc1"), 1);
}

TEST(TankBenchFault, WhenSensorIsFrozen_ThenItGoesOnShowingItsReading) {
  BenchRig rig;
  rig.pump("B1", 1.0);
  const int reading = rig.sensor("S1");
  ASSERT_TRUE(rig.plant().inject_fault("frozen_s1", 1.0));
  rig.pump("B1", 3.0);
  EXPECT_EQ(rig.sensor("S1"), reading);
  EXPECT_GT(rig.truth("level_v1_percent"), 30.0);
  ASSERT_TRUE(rig.plant().clear_fault("frozen_s1"));
  EXPECT_GT(rig.sensor("S1"), reading + 100);
  EXPECT_FALSE(rig.plant().inject_fault("frozen_s1", 0.5));
}

TEST(TankBenchFault, WhenSensorDrifts_ThenReadingWalksAwayFromTheLevel) {
  BenchRig rig;
  rig.run(1.0);
  ASSERT_TRUE(rig.plant().inject_fault("drift_s2", 5.0));
  EXPECT_EQ(rig.sensor("S2"), 736);
  rig.run(10.0);
  EXPECT_EQ(rig.sensor("S2"), 786);
  EXPECT_EQ(rig.sensor("S3"), 1061);
  ASSERT_TRUE(rig.plant().clear_fault("drift_s2"));
  EXPECT_EQ(rig.sensor("S2"), 736);
}

TEST(TankBenchFault, WhenClientDrawsExtra_ThenItTakesTheAmountAndStops) {
  BenchRig rig;
  ASSERT_TRUE(rig.plant().inject_fault("draw_c2", 8.0));
  rig.run(10.0);
  EXPECT_GE(rig.truth("delivered_c2_percent"), 8.0);
  EXPECT_LT(rig.truth("delivered_c2_percent"), 8.6);  // the pump runs down
  EXPECT_NEAR(rig.truth("level_a2_percent"), 20.0 - rig.truth("delivered_c2_percent"), 1e-9);
  EXPECT_NEAR(rig.truth("speed_b4"), 0.0, 1e-4);
}

TEST(TankBenchFault, WhenExtraDrawEndsDuringACommandedDraw_ThenTheCommandGoesOn) {
  BenchRig rig;
  rig.set("B4", true);
  ASSERT_TRUE(rig.plant().inject_fault("draw_c2", 2.0));
  rig.run(4.0);
  EXPECT_GT(rig.truth("delivered_c2_percent"), 10.0);
  EXPECT_GT(rig.truth("flow_b4"), 0.05);
}

TEST(TankBenchFault, WhenNameIsUnknown_ThenErrorListsTheKnownOnes) {
  BenchRig rig;
  for (const auto& failed : {rig.plant().inject_fault("leak_a3", 1.0), rig.plant().clear_fault("leak_a3")}) {
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().front().code, "C0311");
    for (const core::Quantity& known : rig.plant().faults()) {
      EXPECT_NE(failed.error().front().hint.find(known.name), std::string::npos) << known.name;
    }
  }
}

TEST(TankBenchFault, WhenValueIsOutOfRange_ThenRefusedAndNothingChanges) {
  BenchRig rig;
  const std::pair<const char*, double> wrong[] = {
      {"leak_a1", -1.0}, {"weak_b1", 1.5}, {"stuck_fc1", 0.5}, {"drift_s1", 1e9}, {"draw_c1", -1.0}};
  for (const auto& [name, value] : wrong) {
    const auto failed = rig.plant().inject_fault(name, value);
    ASSERT_FALSE(failed) << name;
    EXPECT_EQ(failed.error().front().code, "C0312");
  }
  EXPECT_FALSE(rig.plant().inject_fault("leak_a1", std::numeric_limits<double>::quiet_NaN()));
  rig.run(5.0);
  EXPECT_DOUBLE_EQ(rig.truth("level_a1_percent"), 20.0);
  EXPECT_EQ(rig.sensor("fc1"), 1);
}

TEST(TankBenchFault, WhenItsValueIsVeryLargeOrSmall_ThenTheMessageSaysItShortAndRight) {
  BenchRig rig;
  const std::pair<double, const char*> wrong[] = {{1e300, "the value 1e+300"},
                                                  {-1e-9, "the value -1e-09"},
                                                  {-123456.5, "the value -123456.5"},
                                                  {-20.0, "the value -20"}};
  for (const auto& [value, text] : wrong) {
    const auto failed = rig.plant().inject_fault("leak_a1", value);
    ASSERT_FALSE(failed) << text;
    EXPECT_TRUE(failed.error().front().message.ends_with(text)) << failed.error().front().message;
  }
}

TEST(TankBenchFault, WhenEveryFaultHolds_ThenThePlantGoesOnAndKeepsItsLiquid) {
  BenchRig rig;
  for (const core::Quantity& fault : rig.plant().faults()) {
    ASSERT_TRUE(rig.plant().inject_fault(fault.name, 1.0)) << fault.name;
  }
  for (const char* output : {"B1", "B2", "B3", "B4", "drive_left"}) rig.set(output, true);
  rig.run(300.0);
  EXPECT_NEAR(rig.truth("total_liquid"), 12.8, 1e-8);
  EXPECT_GT(rig.truth("sump"), 12.0);
}

}  // namespace
}  // namespace stepwright::assemblies
