#include "supervisor/fleet/control/leg.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/supervisor/fleet/control/made_path.h"

namespace stepwright::fleet {
namespace {

using geometry::Travel;

TEST(Leg, Split_WhenTheDirectionChanges_ThenEachPartBeginsAtTheCusp) {
  const auto path = MadePath({1, 2, 0}).drive(3.0).drive(2.0, 0.0, Travel::Reverse).drive(4.0, 0.2).path();
  const auto legs = split_into_legs(path, 2.0);
  ASSERT_EQ(legs.size(), 3u);
  EXPECT_EQ(legs[0].sign(), 1.0);
  EXPECT_EQ(legs[1].sign(), -1.0);
  EXPECT_NEAR(legs[1].begin_m(), 3.0, 1e-9);
  EXPECT_NEAR(legs[1].end_m(), 5.0, 1e-9);
  EXPECT_NEAR(legs[1].at(4.0).pose.x_m, 3.0, 1e-9);
  EXPECT_NEAR(legs[2].at(9.0).lock_rad, std::atan(0.4), 1e-6);
}

TEST(Leg, Split_WhenThePathGoesNowhere_ThenThereAreNoLegs) {
  EXPECT_TRUE(split_into_legs({}, 2.0).empty());
  EXPECT_TRUE(
      split_into_legs({{{1, 1, 0}, 0.0, Travel::Forward}, {{1, 1, 0}, 0.0, Travel::Forward}}, 2.0).empty());
}

TEST(Leg, At_WhenTheVehicleReversesInACurve_ThenItsSteeringIsThatOfTheCurve) {
  const auto legs =
      split_into_legs(MadePath({0, 0, 0}, Travel::Reverse).drive(4.0, 0.25, Travel::Reverse).path(), 2.0);
  ASSERT_EQ(legs.size(), 1u);
  EXPECT_NEAR(legs[0].at(2.0).lock_rad, std::atan(0.5), 1e-6);
  EXPECT_NEAR(legs[0].at(2.0).pose.heading_rad, -0.5, 1e-6);
  EXPECT_NEAR(legs[0].sharpest_1_m(0.0, 4.0), 0.25, 1e-6);
}

TEST(Leg, Nearest_WhenThePlaceIsBesideTheLeg_ThenItsFootIsFound) {
  const auto legs = split_into_legs(MadePath({0, 0, 0}).drive(10.0).path(), 2.0);
  EXPECT_NEAR(legs[0].nearest_m({3.21, 0.4}, 0.0, 10.0), 3.21, 1e-9);
  EXPECT_NEAR(legs[0].nearest_m({3.21, 0.4}, 4.0, 10.0), 4.0, 1e-9);
  EXPECT_NEAR(legs[0].nearest_m({-2.0, 0.4}, 0.0, 10.0), 0.0, 1e-9);
}

}  // namespace
}  // namespace stepwright::fleet
