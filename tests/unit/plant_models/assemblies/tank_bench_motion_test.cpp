#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/plant_models/assemblies/bench_rig.h"

namespace stepwright::assemblies {
namespace {

TEST(TankBenchMotion, WhenMade_ThenStandsAtTheSupplier) {
  const BenchRig rig;
  EXPECT_EQ(rig.truth("position"), 0.0);
  EXPECT_EQ(rig.sensor("fc1"), 1);
  EXPECT_EQ(rig.sensor("fc2"), 0);
  EXPECT_EQ(rig.sensor("fc3"), 0);
}

TEST(TankBenchMotion, WhenNothingDrives_ThenStaysForEver) {
  BenchRig rig;
  rig.run(600.0);
  EXPECT_EQ(rig.truth("position"), 0.0);
}

TEST(TankBenchMotion, WhenDrivenLeft_ThenStopsInsideTheSwitchOfA1) {
  BenchRig rig;
  const double seconds = rig.drive("drive_left", "fc2");
  EXPECT_GT(seconds, 4.0);
  EXPECT_LT(seconds, 6.0);
  rig.run(5.0);
  EXPECT_EQ(rig.sensor("fc2"), 1);
  EXPECT_EQ(rig.sensor("fc1"), 0);
  EXPECT_NEAR(rig.truth("position"), -1.0, 0.03);
}

TEST(TankBenchMotion, WhenTravellingFromA1ToA2_ThenTheSwitchOfF1Pulses) {
  BenchRig rig;
  rig.drive("drive_left", "fc2");
  int pulses = 0, before = 0;
  rig.set("drive_right", true);
  rig.run_until([&] {
    if (rig.sensor("fc1") > before) ++pulses;
    before = rig.sensor("fc1");
    return rig.sensor("fc3") != 0;
  });
  EXPECT_EQ(pulses, 1);
  EXPECT_EQ(before, 0);
}

TEST(TankBenchMotion, WhenLoaded_ThenStartsSlower) {
  BenchParameters full = BenchRig::exact();
  full.tanks[1].initial_percent = 100.0;
  BenchRig light, heavy(full);
  for (BenchRig* rig : {&light, &heavy}) {
    rig->set("drive_left", true);
    rig->run(1.0);
  }
  EXPECT_LT(light.truth("speed"), heavy.truth("speed") - 0.01);  // both negative: to the left
}

TEST(TankBenchMotion, WhenBothDirectionsAreOn_ThenTheBrakeHolds) {
  BenchRig rig;
  rig.set("drive_left", true);
  rig.run(2.0);
  rig.set("drive_right", true);
  rig.run(1.0);
  EXPECT_EQ(rig.truth("speed"), 0.0);
}

TEST(TankBenchMotion, WhenReversedAtSpeed_ThenTurnsAround) {
  BenchRig rig;
  rig.set("drive_left", true);
  rig.run(2.0);
  rig.set("drive_left", false);
  rig.set("drive_right", true);
  rig.run(3.0);
  EXPECT_GT(rig.truth("speed"), 0.2);
}

TEST(TankBenchMotion, WhenDrivenOn_ThenTheEndStopHoldsAndLetsGoAgain) {
  BenchRig rig;
  rig.set("drive_right", true);
  rig.run(20.0);
  EXPECT_EQ(rig.truth("position"), 1.05);
  EXPECT_EQ(rig.truth("speed"), 0.0);
  EXPECT_EQ(rig.sensor("fc3"), 0);
  rig.set("drive_right", false);
  rig.set("drive_left", true);
  rig.run(0.5);
  EXPECT_LT(rig.truth("position"), 1.05);
}

// Standing exactly where a switch changes, and turning there, must not leave switch and position apart.
TEST(TankBenchMotion, WhenTurningAtTheEdgeOfASwitch_ThenSwitchAndPositionAgree) {
  BenchRig rig;
  for (int i = 0; i < 200; ++i) {
    const bool left = i % 2 == 0;
    rig.set("drive_left", left);
    rig.set("drive_right", !left);
    rig.run(0.25 + 0.01 * (i % 17));
    const double away = std::abs(rig.truth("position"));
    if (away < 0.03 - 1e-9) {
      ASSERT_EQ(rig.sensor("fc1"), 1) << "turn " << i;
    }
    if (away > 0.031 + 1e-9) {
      ASSERT_EQ(rig.sensor("fc1"), 0) << "turn " << i;
    }
  }
}

}  // namespace
}  // namespace stepwright::assemblies
