#include "supervisor/fleet/control/path_follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "plant_models/assemblies/forklift.h"
#include "tests/unit/supervisor/fleet/control/made_path.h"

namespace stepwright::fleet {
namespace {

using geometry::Travel;

constexpr geometry::Footprint kOutline{.front_m = 1.6, .rear_m = 2.4, .half_width_m = 0.7};

DriveLimits limits_of_the_plant() {
  const assemblies::ForkliftParameters parameters;
  DriveLimits limits;
  limits.wheelbase_m = parameters.body.wheelbase_m;
  limits.full_lock_rad = assemblies::full_lock_rad(parameters);
  return limits;
}

// A simulated forklift, the real equations with slip and understeer, driven by a follower every 0.1 s.
class Ride {
 public:
  Ride(const geometry::Path& path, std::span<const PathArea> areas, double noise_m = 0.0)
      : follower_(PathFollower::create(path, areas, limits_of_the_plant(), kOutline, {}).value()),
        forklift_(assemblies::Forklift::create(
                      {}, {path.front().pose.x_m, path.front().pose.y_m, path.front().pose.heading_rad})
                      .value()),
        noise_(0.0, 1.0),
        noise_m_(noise_m) {}

  void step(const Clearance& clearance = {}) {
    const auto state = forklift_->state();
    const VehicleState measured{state[assemblies::kForkliftX] + noise_m_ * noise_(random_),
                                state[assemblies::kForkliftY] + noise_m_ * noise_(random_),
                                state[assemblies::kForkliftHeading] + 0.2 * noise_m_ * noise_(random_),
                                state[assemblies::kForkliftWheel] + noise_m_ * noise_(random_),
                                state[assemblies::kForkliftLock]};
    const DriveCommand command = follower_.step(measured, time_s, clearance);
    forklift_->command({true, command.speed_m_s, command.lock_rad});
    time_s += kControlStep_s;
    ASSERT_TRUE(forklift_->advance_to(time_s));
    most_deviation_m = std::max(most_deviation_m, follower_.deviation_m());
  }
  // At rest, as somebody else may have left it.
  void turn_steering(double lock_rad) {
    for (int k = 0; k < 30; ++k) {
      forklift_->command({true, 0.0, lock_rad});
      time_s += kControlStep_s;
      ASSERT_TRUE(forklift_->advance_to(time_s));
    }
  }
  double lock_rad() const { return forklift_->state()[assemblies::kForkliftLock]; }
  void run(double until_s, const Clearance& clearance = {}) {
    while (time_s < until_s && !follower_.arrived() && !follower_.lost()) step(clearance);
  }
  geometry::Pose pose() const {
    return {forklift_->pose().x_m, forklift_->pose().y_m, forklift_->pose().heading_rad};
  }
  PathFollower& follower() { return follower_; }
  assemblies::Forklift& forklift() { return *forklift_; }

  double time_s = 0.0;
  double most_deviation_m = 0.0;

 private:
  PathFollower follower_;
  std::unique_ptr<assemblies::Forklift> forklift_;
  std::mt19937 random_{5};
  std::normal_distribution<double> noise_;
  double noise_m_;
};

geometry::Path with_everything() {
  return MadePath({2, 3, 0.4})
      .drive(6.0)
      .drive(5.0, 0.25)
      .drive(4.0)
      .drive(4.0, -0.2, Travel::Reverse)
      .drive(5.0, 0.0, Travel::Reverse)
      .drive(6.0, -0.25)
      .path();
}

TEST(PathFollower, WhenThePathHasCurvesAndCusps_ThenTheForkliftArrivesWithinCentimetres) {
  const auto path = with_everything();
  Ride ride(path, {});
  ride.run(120.0);
  ASSERT_TRUE(ride.follower().arrived());
  EXPECT_LT(ride.time_s, 60.0);
  EXPECT_LT(ride.most_deviation_m, 0.12);  // the curvature of this path jumps, the steering needs its time
  EXPECT_NEAR(ride.pose().x_m, path.back().pose.x_m, 0.06);
  EXPECT_NEAR(ride.pose().y_m, path.back().pose.y_m, 0.06);
  EXPECT_NEAR(ride.pose().heading_rad, path.back().pose.heading_rad, 0.03);
}

TEST(PathFollower, WhenNavigationIsNoisy_ThenItStillArrives) {
  const auto path = with_everything();
  Ride ride(path, {}, 0.02);
  ride.run(150.0);
  ASSERT_TRUE(ride.follower().arrived());
  EXPECT_LT(geometry::distance(ride.pose().position(), path.back().pose.position()), 0.12);
}

// It used to drive off at once, and so beside its path. In a hall one was seen to stand there for ever, with
// the wrong lock: the controller had found that each way led away from the path.
TEST(PathFollower, WhenItStandsWithItsSteeringTurnedTheOtherWay_ThenItTurnsItBeforeItDrives) {
  constexpr double kMayDiffer_rad = 0.25;
  for (const double curvature : {0.19, -0.19, 0.25}) {
    for (const Travel travel : {Travel::Forward, Travel::Reverse}) {
      const auto path = MadePath({0, 0, 0}).drive(3.0, curvature, travel).path();
      const DriveLimits limits = limits_of_the_plant();
      const double wanted_rad = std::atan(limits.wheelbase_m * curvature);
      Ride ride(path, {}, 0.005);
      ride.turn_steering(curvature > 0.0 ? -limits.full_lock_rad : limits.full_lock_rad);
      while (ride.time_s < 20.0 && std::abs(ride.lock_rad() - wanted_rad) > kMayDiffer_rad) ride.step();
      EXPECT_LT(ride.time_s, 6.0) << curvature;
      EXPECT_LT(std::hypot(ride.pose().x_m, ride.pose().y_m), 0.03) << curvature;
      ride.run(25.0);
      EXPECT_TRUE(ride.follower().arrived()) << curvature;
      EXPECT_LT(ride.most_deviation_m, 0.06) << curvature;
    }
  }
}

// Who stands measures speeds that are not all small.
TEST(PathFollower, WhenItDoesNotMoveAndMeasuredSpeedsSayOtherwise_ThenItIsLost) {
  auto follower = PathFollower::create(MadePath({0, 0, 0}).drive(8.0).path(), {}, {}, kOutline, {}).value();
  int steps = 0;
  for (; steps < 300 && !follower.lost(); ++steps)
    follower.step({.speed_m_s = steps % 3 == 0 ? 0.03 : -0.01}, kControlStep_s * steps, {});
  EXPECT_TRUE(follower.lost());
  EXPECT_NEAR(kControlStep_s * steps, FollowerSettings().stalled_s, 0.5);
}

TEST(PathFollower, WhenItMayGoNoFurther_ThenItStandsBeforeAndGoesOnWhenItMay) {
  Ride ride(MadePath({0, 0, 0}).drive(15.0).path(), {});
  ride.run(30.0, {.permitted_m = 7.0});
  EXPECT_FALSE(ride.follower().arrived());
  EXPECT_LE(ride.pose().x_m, 7.0);
  EXPECT_GT(ride.pose().x_m, 6.7);
  ride.run(60.0);
  EXPECT_TRUE(ride.follower().arrived());
}

TEST(PathFollower, WhenAScheduleSaysWhen_ThenItComesThenAndTellsBefore) {
  Ride ride(MadePath({0, 0, 0}).drive(15.0).path(), {});
  const std::array<Gate, 1> gates = {Gate{10.0, 25.0}};
  const auto expected = ride.follower().expected_s(10.0, 0.0, {.gates = gates});
  ASSERT_TRUE(expected.has_value());
  EXPECT_NEAR(*expected, 25.0, 0.6);
  EXPECT_FALSE(ride.follower().expected_s(14.0, 0.0, {.permitted_m = 12.0}).has_value());
  double passed_s = 0.0;
  while (ride.time_s < 60.0 && !ride.follower().arrived()) {
    ride.step({.gates = gates});
    if (passed_s == 0.0 && ride.pose().x_m >= 10.0) passed_s = ride.time_s;
  }
  EXPECT_NEAR(passed_s, 25.0, 1.0);
}

TEST(PathFollower, WhenAPolygonIsTight_ThenTheOutlineStaysWithinIt) {
  const auto path = MadePath({0, 0, 0}).drive(12.0).path();
  const std::array<geometry::Point, 4> corners = {
      geometry::Point{-4, -0.85}, {16, -0.85}, {16, 0.85}, {-4, 0.85}};
  const std::array<PathArea, 1> areas = {PathArea{*geometry::ConvexPolygon::hull(corners), 0.0, 12.0}};
  Ride ride(path, areas, 0.01);
  while (ride.time_s < 60.0 && !ride.follower().arrived()) {
    ride.step();
    EXPECT_TRUE(areas[0].polygon.contains(geometry::footprint_at(ride.pose(), kOutline), 0.0)) << ride.time_s;
  }
  EXPECT_TRUE(ride.follower().arrived());
}

TEST(PathFollower, WhenTheSteeringIsStuck_ThenItStopsAndIsLost) {
  Ride ride(MadePath({0, 0, 0}).drive(4.0).drive(8.0, 0.25).path(), {});
  ride.run(3.0);
  auto modes = ride.forklift().modes();
  modes.steering_stuck = true;
  ride.forklift().set_modes(modes);
  ride.run(40.0);
  EXPECT_TRUE(ride.follower().lost());
  const auto stopped = ride.pose();
  for (int k = 0; k < 50; ++k) ride.step();
  EXPECT_LT(geometry::distance(ride.pose().position(), stopped.position()), 1.0);
  EXPECT_LT(std::abs(ride.forklift().speed_m_s()), 1e-3);
}

TEST(PathFollower, WhenMeasurementsAreNoNumbers_ThenItStops) {
  auto follower = PathFollower::create(MadePath({0, 0, 0}).drive(4.0).path(), {}, {}, kOutline, {}).value();
  const DriveCommand command = follower.step({.x_m = std::numeric_limits<double>::quiet_NaN()}, 0.0, {});
  EXPECT_EQ(command.speed_m_s, 0.0);
}

TEST(PathFollower, WhenThePathIsNone_ThenItIsRefused) {
  geometry::Path path = MadePath({0, 0, 0}).drive(4.0).path();
  path[3].pose.x_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(PathFollower::create(path, {}, {}, kOutline, {}).error().front().code, "F1201");
  EXPECT_EQ(PathFollower::create({}, {}, {}, kOutline, {}).error().front().code, "F1201");
}

}  // namespace
}  // namespace stepwright::fleet
