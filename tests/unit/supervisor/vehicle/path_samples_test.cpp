#include "supervisor/vehicle/path_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stepwright::vehicle {
namespace {

using geometry::Travel;

// A quarter of a circle to the left of this radius.
PathLeg curve(double radius_m, Travel travel) {
  const double way = travel == Travel::Reverse ? -1.0 : 1.0;
  PathLeg leg;
  for (int k = 0; k <= 20; ++k) {
    const double turned = way * k * std::numbers::pi / 40.0;
    leg.push_back({{radius_m * std::sin(turned), radius_m * (1.0 - std::cos(turned)), turned},
                   std::abs(turned) * radius_m,
                   travel});
  }
  return leg;
}

TEST(PathSamples, WhenAWayIsACircle_ThenItsCurvatureAndItsSpeedFollow) {
  const auto samples =
      path_samples({curve(4.0, Travel::Forward)}, {.wheelbase_m = 1.0, .speed = {.lateral_m_s2 = 0.25}});
  ASSERT_EQ(samples.size(), 21u);
  for (const PathSample& each : samples) EXPECT_NEAR(each.curvature_1_m, 0.25, 1e-9);
  EXPECT_NEAR(samples.front().speed_m_s, 1.0, 1e-9) << "sqrt(lateral / curvature)";
  EXPECT_EQ(samples.back().speed_m_s, 0.0);
  EXPECT_NEAR(samples[19].speed_m_s, std::sqrt(2.0 * 0.6 * (samples[20].arc_m - samples[19].arc_m)), 1e-9);
}

TEST(PathSamples, WhenAWayGoesBack_ThenThePlaceOfRestIsThereTwiceAndCurvatureIsThatOfTheSteering) {
  const PathLeg ahead = {{{0, 0, 0}, 0.0, Travel::Forward}, {{1, 0, 0}, 1.0, Travel::Forward}};
  PathLeg back = curve(2.0, Travel::Reverse);
  for (geometry::PathPose& each : back) {
    each.pose.x_m += 1.0;
    each.arc_m += 1.0;
  }
  const auto samples = path_samples({ahead, back}, {.wheelbase_m = 1.0, .speed = {}});
  ASSERT_EQ(samples.size(), 23u);
  EXPECT_EQ(samples[1].arc_m, samples[2].arc_m);
  EXPECT_EQ(samples[0].rest_m, 1.0);
  EXPECT_EQ(samples[2].rest_m, back.back().arc_m);
  EXPECT_EQ(samples[2].way, -1.0);
  EXPECT_NEAR(samples[5].curvature_1_m, 0.5, 1e-9)
      << "the heading falls, backwards: the wheel is turned left";
}

TEST(PathSamples, WhenHeadingsPassHalfATurn_ThenTheyDoNotLeap) {
  PathLeg leg;
  for (int k = 0; k < 10; ++k)
    leg.push_back(
        {{0.1 * k, 0.0, std::remainder(3.0 + 0.05 * k, 2.0 * std::numbers::pi)}, 0.1 * k, Travel::Forward});
  const auto samples = path_samples({leg}, {});
  for (std::size_t k = 1; k < samples.size(); ++k)
    EXPECT_NEAR(samples[k].pose.heading_rad - samples[k - 1].pose.heading_rad, 0.05, 1e-9);
}

}  // namespace
}  // namespace stepwright::vehicle
