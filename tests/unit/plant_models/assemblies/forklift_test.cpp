#include "plant_models/assemblies/forklift.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/malloc_guard.h"

namespace stepwright::assemblies {
namespace {

constexpr double kScanS = 0.01;

// Without slip, so that the way is the command's.
ForkliftParameters ideal() {
  ForkliftParameters parameters;
  parameters.slip = {.drive_slip = 0.0, .understeer_s2_m2 = 0.0, .load_understeer_s2_m2_kg = 0.0};
  return parameters;
}

std::unique_ptr<Forklift> make(const ForkliftParameters& parameters = ideal(),
                               const ForkliftPose& start = {}) {
  return Forklift::create(parameters, start).value();
}

void run(Forklift& forklift, double& t_s, double seconds) {
  const double end = t_s + seconds;
  while (t_s < end - 1e-9) ASSERT_TRUE(forklift.advance_to(t_s += kScanS));
}

TEST(Forklift, WhenItDrivesStraight_ThenTheLagCostsItsTimeConstantOfWay) {
  ForkliftParameters parameters = ideal();
  parameters.drive.drive_force_n = 1e6;  // no limit: the first-order lag alone
  auto forklift = make(parameters, {1.0, 2.0, 0.0});
  forklift->command({true, 1.0, 0.0});
  double t_s = 0.0;
  run(*forklift, t_s, 6.0);
  const double lag_s = parameters.drive.time_constant_s;
  EXPECT_NEAR(forklift->pose().x_m, 1.0 + 6.0 - lag_s * (1.0 - std::exp(-6.0 / lag_s)), 1e-5);
  EXPECT_NEAR(forklift->pose().y_m, 2.0, 1e-12);
  EXPECT_NEAR(forklift->speed_m_s(), 1.0, 1e-5);
}

TEST(Forklift, WhenItTurnsAtFullLock_ThenItDrivesACircleOfTheTurningRadius) {
  auto forklift = make();
  forklift->command({true, 0.0, 10.0});  // more than there is
  double t_s = 0.0;
  run(*forklift, t_s, 3.0);
  forklift->command({true, 1.0, 10.0});
  run(*forklift, t_s, 10.0);
  EXPECT_NEAR(forklift->curvature_1_m(), 1.0 / 3.5, 1e-6);
  // The left centre of the circle is where it was: 3.5 m to the left of the start.
  const ForkliftPose pose = forklift->pose();
  EXPECT_NEAR(pose.x_m - 3.5 * std::sin(pose.heading_rad), 0.0, 1e-3);
  EXPECT_NEAR(pose.y_m + 3.5 * std::cos(pose.heading_rad), 3.5, 1e-3);
  EXPECT_GT(pose.heading_rad, 2.0);
}

TEST(Forklift, WhenItReversesOnTheSameLock_ThenItComesBackOnTheSameCircle) {
  auto forklift = make();
  forklift->command({true, 0.0, -0.3});
  double t_s = 0.0;
  run(*forklift, t_s, 3.0);
  const double lock = forklift->state()[kForkliftLock];
  EXPECT_NEAR(lock, -0.3, 1e-5);
  forklift->command({true, -1.2, -0.3});
  run(*forklift, t_s, 5.0);
  const double radius = -1.9 / std::tan(0.3);  // to the right
  const ForkliftPose pose = forklift->pose();
  EXPECT_NEAR(pose.x_m - radius * std::sin(pose.heading_rad), 0.0, 1e-3);
  EXPECT_NEAR(pose.y_m + radius * std::cos(pose.heading_rad), radius, 1e-3);
  EXPECT_GT(pose.heading_rad, 0.5);  // backwards to the right: the front swings left
}

TEST(Forklift, WhenItIsLoaded_ThenItStartsSlower) {
  const auto way_in_two_seconds = [](double load_kg) {
    ForkliftParameters parameters = ideal();
    parameters.drive.time_constant_s = 0.02;  // the force decides
    auto forklift = make(parameters);
    ForkliftModes modes;
    modes.load_kg = load_kg;
    forklift->set_modes(modes);
    forklift->command({true, 1.5, 0.0});
    double t_s = 0.0;
    run(*forklift, t_s, 1.5);
    return forklift->pose().x_m;
  };
  EXPECT_NEAR(way_in_two_seconds(0.0), 0.5 * 3600.0 / 4500.0 * 1.5 * 1.5, 1e-2);
  EXPECT_NEAR(way_in_two_seconds(2500.0), 0.5 * 3600.0 / 7000.0 * 1.5 * 1.5, 1e-2);
}

TEST(Forklift, WhenTheDriveIsDisabled_ThenTheSpringBrakeStopsItInItsWay) {
  ForkliftParameters parameters = ideal();
  parameters.drive.time_constant_s = 0.02;
  auto forklift = make(parameters);
  forklift->command({true, 1.5, 0.0});
  double t_s = 0.0;
  run(*forklift, t_s, 6.0);
  const double x_m = forklift->pose().x_m;
  forklift->command({false, 1.5, 0.3});
  run(*forklift, t_s, 3.0);
  EXPECT_NEAR(forklift->speed_m_s(), 0.0, 1e-6);
  const double braking_m = 1.5 * 1.5 / 2.0 / (12000.0 / 4500.0);
  EXPECT_NEAR(forklift->pose().x_m - x_m, braking_m, 0.01);
  EXPECT_NEAR(forklift->state()[kForkliftLock], 0.0, 1e-9);  // no power, no steering
}

TEST(Forklift, WhenItSlips_ThenTheGroundSeesLessThanTheOdometer) {
  ForkliftParameters parameters = ideal();
  parameters.slip.drive_slip = 0.02;
  auto forklift = make(parameters);
  ForkliftModes modes;
  modes.extra_slip = 0.1;
  forklift->set_modes(modes);
  forklift->command({true, 1.0, 0.0});
  double t_s = 0.0;
  run(*forklift, t_s, 10.0);
  EXPECT_NEAR(forklift->pose().x_m, 0.88 * forklift->state()[kForkliftTravel], 1e-6);
}

TEST(Forklift, WhenItIsFastOrLoaded_ThenItUndersteers) {
  const auto curvature = [](double speed_m_s, double load_kg) {
    auto forklift = make({});
    ForkliftModes modes;
    modes.load_kg = load_kg;
    forklift->set_modes(modes);
    forklift->command({true, speed_m_s, 0.2});
    double t_s = 0.0;
    run(*forklift, t_s, 10.0);
    return forklift->curvature_1_m();
  };
  EXPECT_LT(curvature(1.4, 0.0), curvature(0.2, 0.0));
  EXPECT_LT(curvature(1.4, 2000.0), curvature(1.4, 0.0));
}

// Runge and Kutta's method of order four with steps of 0.1 ms as the truth.
TEST(Forklift, WhenCommandsChangeAllTheTime_ThenTheStateIsThatOfAFineIntegration) {
  const ForkliftParameters parameters;
  auto forklift = make(parameters);
  ForkliftEquations truth(parameters);
  std::array<double, kForkliftStates> y{};
  const auto slope = [&](const std::array<double, kForkliftStates>& at) {
    std::array<double, kForkliftStates> d{};
    truth.derivative(0.0, at, d);
    return d;
  };
  const auto moved = [](auto at, const auto& d, double h) {
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += h * d[i];
    return at;
  };
  constexpr double kStepS = 1e-4;
  for (int scan = 0; scan < 1500; ++scan) {
    const double t_s = scan * kScanS;
    const ForkliftCommand command{scan % 400 != 399, 1.4 * std::sin(0.7 * t_s), 0.5 * std::cos(1.3 * t_s)};
    forklift->command(command);
    truth.modes = forklift->modes();
    ASSERT_TRUE(forklift->advance_to((scan + 1) * kScanS));
    for (int k = 0; k < 100; ++k) {
      const auto a = slope(y);
      const auto b = slope(moved(y, a, kStepS / 2));
      const auto c = slope(moved(y, b, kStepS / 2));
      const auto d = slope(moved(y, c, kStepS));
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += kStepS / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }
    for (std::size_t i = 0; i < y.size(); ++i)
      ASSERT_NEAR(forklift->state()[i], y[i], 2e-4) << scan << " " << i;
  }
}

TEST(Forklift, WhenTimeIsSlicedFiner_ThenTheStateIsBitIdentical) {
  const auto end = [](int slices) {
    auto forklift = make({});
    for (int scan = 0; scan < 500; ++scan) {
      if (scan % 3 == 0) forklift->command({true, 0.01 * (scan % 150), 0.002 * (scan % 100)});
      for (int k = 1; k <= slices; ++k)
        forklift->advance_to(scan == 499 && k == slices ? 5.0 : (scan + 1.0 * k / slices) * kScanS);
    }
    return std::vector<double>(forklift->state().begin(), forklift->state().end());
  };
  EXPECT_EQ(end(1), end(4));
}

TEST(Forklift, WhenACommandIsNoNumber_ThenTheDriveIsOff) {
  auto forklift = make();
  forklift->command({true, std::numeric_limits<double>::quiet_NaN(), 0.0});
  EXPECT_FALSE(forklift->modes().enabled);
  forklift->command({true, 1.0, std::numeric_limits<double>::infinity()});
  EXPECT_FALSE(forklift->modes().enabled);
  EXPECT_TRUE(forklift->advance_to(1.0));
  EXPECT_EQ(forklift->pose(), ForkliftPose{});
}

TEST(Forklift, WhenFiguresMakeNoSense_ThenEachIsNamed) {
  ForkliftParameters parameters;
  parameters.body.wheelbase_m = 5.0;
  parameters.drive.empty_mass_kg = -1.0;
  parameters.slip.drive_slip = 1.0;
  parameters.steering.turning_radius_m = std::numeric_limits<double>::quiet_NaN();
  const auto forklift = Forklift::create(parameters, {});
  ASSERT_FALSE(forklift);
  EXPECT_EQ(forklift.error().size(), 4u) << result::to_string(forklift.error());
}

TEST(Forklift, WhenRunning_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  auto forklift = make({});
  const support::GuardCounts before = support::guard_counts();
  for (int scan = 0; scan < 1000; ++scan) {
    forklift->command({true, 0.001 * scan, 0.1});
    forklift->advance_to((scan + 1) * kScanS);
  }
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::assemblies
