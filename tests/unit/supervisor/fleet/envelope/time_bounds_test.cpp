#include "supervisor/fleet/envelope/time_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

TEST(TimeBounds, Bounds_WhenNotWhole_ThenBothAreDrivable) {
  EXPECT_EQ(time_bounds(3.0, {.min_mps = 0.05, .max_mps = 1.5}), (Bounds{2000ms, 60000ms}));
  for (const double length_m : {0.013, 0.71, 1.0 / 3.0, 12.3456}) {
    const Bounds bounds = time_bounds(length_m, {.min_mps = 0.07, .max_mps = 1.3});
    EXPECT_LE(length_m / (static_cast<double>(bounds.least.count()) / 1000.0), 1.3);
    EXPECT_GE(length_m / (static_cast<double>(bounds.most.count()) / 1000.0), 0.07);
    EXPECT_GT(length_m / (static_cast<double>(bounds.least.count() - 1) / 1000.0), 1.3);
    EXPECT_LT(length_m / (static_cast<double>(bounds.most.count() + 1) / 1000.0), 0.07);
  }
}

TEST(TimeBounds, Bounds_WhenNoWholeMillisecondLiesBetween_ThenTheLeastPossibleIsBoth) {
  EXPECT_EQ(time_bounds(0.0005, {.min_mps = 1.0, .max_mps = 1.5}), (Bounds{1ms, 1ms}));
  EXPECT_EQ(time_bounds(0.0, {}), (Bounds{0ms, 0ms}));
}

TEST(TimeBounds, Bounds_WhenTheVehicleMayStop_ThenTheHorizonBounds) {
  EXPECT_EQ(time_bounds(1.0, {.min_mps = 0.0, .max_mps = 1.0, .horizon = 50s}), (Bounds{1000ms, 50s}));
  EXPECT_EQ(time_bounds(1e9, {.min_mps = 0.0, .max_mps = 1.0, .horizon = 50s}), (Bounds{50s, 50s}));
}

TEST(TimeBounds, Check_WhenSpeedsAreWrong_ThenTheirKeysAreNamed) {
  const auto complaint = [](const SpeedLimits& limits) {
    return to_string(check(limits, {"f.json", 2, 5}, "vehicles[0]."));
  };
  EXPECT_EQ(complaint({}), "");
  EXPECT_THAT(complaint({.max_mps = 0.0}), HasSubstr("f.json:2:5: F0502: vehicles[0].max_mps is 0 m/s"));
  EXPECT_THAT(complaint({.max_mps = std::numeric_limits<double>::quiet_NaN()}),
              HasSubstr("vehicles[0].max_mps"));
  EXPECT_THAT(complaint({.min_mps = 2.0, .max_mps = 1.5}),
              HasSubstr("vehicles[0].min_mps is 2 m/s, outside 0 to vehicles[0].max_mps 1.5 m/s"));
  EXPECT_THAT(complaint({.min_mps = -0.1}), HasSubstr("vehicles[0].min_mps"));
}

}  // namespace
}  // namespace stepwright::fleet
