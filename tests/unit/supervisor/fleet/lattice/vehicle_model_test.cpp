#include "supervisor/fleet/lattice/vehicle_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace stepwright::fleet {
namespace {

using ::testing::HasSubstr;

std::string complaint(const VehicleModel& vehicle) {
  return to_string(check(vehicle, {"fleet.json", 3, 7}, "vehicles[1]."));
}

TEST(VehicleModel, Check_WhenNothingIsWrong_ThenNothingIsSaid) {
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({.wheelbase_m = 2.0, .min_turning_radius_m = 2.0, .max_steering_rad = 0.79}), "");
}

TEST(VehicleModel, Check_WhenAValueIsNoLength_ThenItsKeyIsNamed) {
  EXPECT_THAT(complaint({.wheelbase_m = -1.0}),
              HasSubstr("fleet.json:3:7: F0201: vehicles[1].wheelbase_m is -1 m"));
  EXPECT_THAT(complaint({.min_turning_radius_m = 0.0}), HasSubstr("F0201: vehicles[1].min_turning_radius_m"));
  EXPECT_THAT(complaint({.front_m = std::numeric_limits<double>::quiet_NaN()}),
              HasSubstr("vehicles[1].front_m"));
  EXPECT_THAT(complaint({.rear_m = 1e9}), HasSubstr("vehicles[1].rear_m"));
  EXPECT_THAT(complaint({.width_m = std::numeric_limits<double>::infinity()}),
              HasSubstr("vehicles[1].width_m"));
  EXPECT_THAT(complaint({.max_steering_rad = 2.0}), HasSubstr("F0201: vehicles[1].max_steering_rad"));
}

TEST(VehicleModel, Check_WhenValuesContradictEachOther_ThenBothKeysAreNamed) {
  EXPECT_THAT(
      complaint({.wheelbase_m = 4.1}),
      HasSubstr(
          "F0202: vehicles[1].wheelbase_m is 4.1 m, longer than the vehicle: vehicles[1].front_m 1.6 m"));
  EXPECT_THAT(complaint({.wheelbase_m = 2.0, .min_turning_radius_m = 1.9, .max_steering_rad = 0.7853}),
              HasSubstr("F0202: vehicles[1].min_turning_radius_m is 1.9 m, but vehicles[1].wheelbase_m 2 m"));
}

TEST(VehicleModel, Radii_WhenTheReferenceIsOffCentre_ThenTheNearestAndTheFarthestSideCount) {
  const VehicleModel vehicle{.front_m = 0.5, .rear_m = 3.0, .width_m = 1.6};
  EXPECT_DOUBLE_EQ(vehicle.inscribed_radius_m(), 0.5);
  EXPECT_DOUBLE_EQ(vehicle.circumscribed_radius_m(), std::hypot(3.0, 0.8));
}

}  // namespace
}  // namespace stepwright::fleet
