// The drive of a belt against the closed solution of its equations.

#include "plant_models/assemblies/belt_drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
namespace {

BeltDrive make() {
  return std::move(*BeltDrive::create({}));
}

void run(BeltDrive& drive, double from_s, double to_s) {
  for (int i = 1; from_s + 0.005 * i <= to_s + 1e-9; ++i) ASSERT_TRUE(drive.advance_to(from_s + 0.005 * i));
}

// At the limit the current is 8 (1 - exp(-t / tau)), and from 10 N on it accelerates 20 kg.
TEST(BeltDrive, WhenItStarts_ThenItSpeedsUpAtTheLimitOfItsCurrent) {
  BeltDrive drive = make();
  drive.command(true);
  run(drive, 0.0, 0.1);
  const double tau = 0.02;
  EXPECT_NEAR(drive.current_a(), 8.0 * (1.0 - std::exp(-0.1 / tau)), 0.01);
  const double start = -tau * std::log(1.0 - 1.0 / 8.0);  // the force has reached the friction
  const auto impulse = [&](double t) { return 80.0 * (t + tau * std::exp(-t / tau)) - 10.0 * t; };
  EXPECT_NEAR(drive.speed_m_s(), (impulse(0.1) - impulse(start)) / 20.0, 2e-3);
}

TEST(BeltDrive, WhenItRuns_ThenItKeepsItsSpeedButForTheDroopThatFrictionCosts) {
  BeltDrive drive = make();
  drive.command(true);
  run(drive, 0.0, 2.0);
  EXPECT_NEAR(drive.speed_m_s(), 0.5 - 1.0 / 200.0, 1e-4);  // 10 N are 1 A, 1 A is 1/200 m/s
  drive.load(30.0);
  run(drive, 2.0, 4.0);
  EXPECT_NEAR(drive.speed_m_s(), 0.5 - 4.0 / 200.0, 1e-4);
}

TEST(BeltDrive, WhenItGetsUpToSpeed_ThenItOvershootsByLessThanATenth) {
  BeltDrive drive = make();
  drive.command(true);
  double fastest = 0.0;
  for (int i = 1; i <= 400; ++i) {
    ASSERT_TRUE(drive.advance_to(0.005 * i));
    fastest = std::max(fastest, drive.speed_m_s());
  }
  EXPECT_GT(fastest, 0.5);
  EXPECT_LT(fastest, 0.5 * 1.1);
}

TEST(BeltDrive, WhenItIsOverloaded_ThenItComesToAStandAndDoesNotRunBackwards) {
  BeltDrive drive = make();
  drive.command(true);
  run(drive, 0.0, 1.0);
  drive.load(90.0);
  run(drive, 1.0, 3.0);
  EXPECT_EQ(drive.speed_m_s(), 0.0);
  EXPECT_NEAR(drive.current_a(), 8.0, 1e-3);
  drive.load(0.0);
  run(drive, 3.0, 4.0);
  EXPECT_GT(drive.speed_m_s(), 0.45);
}

TEST(BeltDrive, WhenItIsSwitchedOff_ThenTheBrakeStopsItAndNothingIsIntegratedAtRest) {
  BeltDrive drive = make();
  drive.command(true);
  run(drive, 0.0, 1.0);
  drive.command(false);
  double way = 0.0;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(drive.advance_to(1.0 + 0.005 * (i + 1)));
    way += drive.speed_m_s() * 0.005;
  }
  EXPECT_EQ(drive.speed_m_s(), 0.0);
  EXPECT_NEAR(way, 0.5 * 0.5 / (2.0 * 80.0 / 20.0), 0.01);  // friction and brake: 4 m/s2
  const auto steps = drive.statistics().steps;
  run(drive, 1.5, 10.0);
  EXPECT_EQ(drive.statistics().steps, steps);
}

}  // namespace
}  // namespace stepwright::assemblies
