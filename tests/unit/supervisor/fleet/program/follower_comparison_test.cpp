// The path follower in ST beside the model predictive controller in C++: same path, same vehicle, same noise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "supervisor/fleet/control/path_follower.h"
#include "tests/support/fleet_program/fleet_rig.h"
#include "tests/support/fleet_program/planned_fleet.h"
#include "tests/unit/supervisor/fleet/control/made_path.h"

namespace stepwright::fleet {
namespace {

using geometry::Travel;

constexpr geometry::Footprint kOutline{.front_m = 1.6, .rear_m = 2.4, .half_width_m = 0.7};

struct Ride {
  double time_s = 0.0;
  double most_deviation_m = 0.0;
  double miss_m = 0.0;  // of the end of the path
  bool arrived = false;
};

// How far the true place is from the path, which is dense.
double off_path_m(const geometry::Path& path, const geometry::Pose& pose, double from_m, double to_m) {
  double least = 1e9;
  for (const geometry::PathPose& at : path) {
    if (at.arc_m < from_m || at.arc_m > to_m) continue;
    least = std::min(least, geometry::distance(at.pose.position(), pose.position()));
  }
  return least;
}

Ride ride_of_the_program(const geometry::Path& path) {
  const FleetPlan plan = plan_alone(path);
  FleetRig rig(plan, {.native = false});
  Ride ride;
  while (rig.time_s() < 240.0 && !rig.all_arrived()) {
    rig.scan();
    const double arc = rig.of("Arc", 0);
    ride.most_deviation_m =
        std::max(ride.most_deviation_m, off_path_m(path, rig.pose(0), arc - 1.0, arc + 1.0));
  }
  ride.time_s = rig.time_s();
  ride.arrived = rig.all_arrived();
  ride.miss_m = geometry::distance(rig.pose(0).position(), path.back().pose.position());
  return ride;
}

Ride ride_of_the_controller(const geometry::Path& path) {
  const geometry::Pose& start = path.front().pose;
  assemblies::FleetParameters parameters;
  parameters.starts = {{start.x_m, start.y_m, start.heading_rad}};
  auto floor = assemblies::FleetFloor::create(parameters).value();
  const auto sensor = [&](const char* name) { return floor->sensor(*core::find_sensor(*floor, name)); };
  const auto actuator = [&](const char* name, double value) {
    floor->set_actuator(*core::find_actuator(*floor, name), static_cast<std::int16_t>(std::lround(value)));
  };
  const DriveLimits limits{.full_lock_rad = assemblies::full_lock_rad(parameters.forklift)};
  auto follower = PathFollower::create(path, {}, limits, kOutline, {}).value();
  constexpr double kRadPerCount = 3.14159265358979 / 18000.0;
  Ride ride;
  actuator("enable_v1", 1);
  while (ride.time_s < 240.0 && !follower.arrived() && !follower.lost()) {
    const VehicleState measured{0.01 * sensor("x_v1"), 0.01 * sensor("y_v1"),
                                kRadPerCount * sensor("heading_v1"), 1e-3 * sensor("speed_v1"),
                                kRadPerCount * sensor("lock_v1")};
    const DriveCommand command = follower.step(measured, ride.time_s, {});
    actuator("set_speed_v1", 1e3 * command.speed_m_s);
    actuator("set_lock_v1", command.lock_rad / kRadPerCount);
    for (int k = 1; k <= 5; ++k) {
      ride.time_s += kControlStep_s / 5.0;
      (void)floor->advance_to(std::chrono::nanoseconds(std::llround(1e9 * ride.time_s)));
      const auto at = floor->vehicle_pose(0);
      const double arc = follower.arc_m();
      ride.most_deviation_m =
          std::max(ride.most_deviation_m, off_path_m(path, {at.x_m, at.y_m, 0.0}, arc - 1.0, arc + 1.0));
    }
  }
  const auto at = floor->vehicle_pose(0);
  ride.arrived = follower.arrived();
  ride.miss_m = geometry::distance({at.x_m, at.y_m}, path.back().pose.position());
  return ride;
}

// For reports: --gtest_output=xml.
void record(const std::string& who, const Ride& ride) {
  testing::Test::RecordProperty(who + "_deviation_m", std::to_string(ride.most_deviation_m));
  testing::Test::RecordProperty(who + "_s", std::to_string(ride.time_s));
  testing::Test::RecordProperty(who + "_miss_m", std::to_string(ride.miss_m));
}

void expect_as_good(const geometry::Path& path, double most_miss_m = 0.12) {
  const Ride program = ride_of_the_program(path);
  const Ride controller = ride_of_the_controller(path);
  record("program", program);
  record("controller", controller);
  EXPECT_TRUE(program.arrived);
  EXPECT_TRUE(controller.arrived);
  EXPECT_LT(program.most_deviation_m, controller.most_deviation_m + 0.05);
  EXPECT_LT(program.time_s, 1.15 * controller.time_s + 3.0);
  EXPECT_LT(program.miss_m, most_miss_m);
}

TEST(PathFollowerInTheScan, WhenThePathHasCurvesAndCusps_ThenItIsAsGoodAsTheController) {
  expect_as_good(MadePath({2, 3, 0.4})
                     .drive(6.0)
                     .drive(5.0, 0.25)
                     .drive(4.0)
                     .drive(4.0, -0.2, Travel::Reverse)
                     .drive(5.0, 0.0, Travel::Reverse)
                     .drive(6.0, -0.25)
                     .path());
}

TEST(PathFollowerInTheScan, WhenThePathTurnsToAndFro_ThenItIsAsGoodAsTheController) {
  expect_as_good(MadePath({50, 40, 2.0})
                     .drive(3.0)
                     .drive(4.0, 0.2)
                     .drive(6.0, -0.2)
                     .drive(5.0)
                     .drive(8.0, 0.22)
                     .drive(3.0, -0.15)
                     .drive(4.0)
                     .path());
}

// Nothing is left to steer with: whoever is outside of such a curve stays there until it ends.
TEST(PathFollowerInTheScan, WhenThePathIsAsTightAsFullLock_ThenBothArrive) {
  constexpr double kFullLock = 1.0 / 3.5;
  expect_as_good(MadePath({2, 3, 0.4})
                     .drive(6.0)
                     .drive(5.0, kFullLock)
                     .drive(4.0)
                     .drive(4.0, -kFullLock, Travel::Reverse)
                     .drive(5.0, 0.0, Travel::Reverse)
                     .drive(6.0, -kFullLock)
                     .path(),
                 0.2);  // it ends within the curve, as far outside as it was driven
}

TEST(PathFollowerInTheScan, WhenFullLockTurnsToAndFro_ThenBothArrive) {
  constexpr double kFullLock = 1.0 / 3.5;
  expect_as_good(MadePath({50, 40, 2.0})
                     .drive(3.0)
                     .drive(4.0, kFullLock)
                     .drive(6.0, -kFullLock)
                     .drive(5.0)
                     .drive(8.0, kFullLock)
                     .drive(3.0, -kFullLock)
                     .drive(4.0)
                     .path());
}

}  // namespace
}  // namespace stepwright::fleet
