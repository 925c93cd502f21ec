#include "supervisor/fleet/executive/lead_in.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stepwright::fleet {
namespace {

constexpr GridFrame kFrame{.resolution_m = 0.2, .origin = {0.0, 0.0}, .columns = 100, .rows = 100};

// Along x from 2.0 m on, a pose every 5 cm; poses of the lattice are those at multiples of 0.2 m.
geometry::Path straight(int poses) {
  geometry::Path path;
  for (int k = 0; k < poses; ++k)
    path.push_back({{2.0 + 0.05 * k, 4.0, 0.0}, 0.05 * k, geometry::Travel::Forward});
  return path;
}

TEST(LeadIn, WhenTheVehicleStandsBetweenPosesOfTheLattice_ThenItMayDriveOnOrBack) {
  const auto ways = lead_ins(straight(41), 0.7, kFrame);  // 2.7 m: between 2.6 and 2.8
  ASSERT_EQ(ways.size(), 2u);
  EXPECT_NEAR(ways[0].start.x_m, 2.8, 1e-9);
  EXPECT_EQ(ways[0].path.size(), 3u);
  EXPECT_EQ(ways[0].path.front().arc_m, 0.0);
  EXPECT_EQ(ways[0].path.back().travel, geometry::Travel::Forward);
  EXPECT_NEAR(ways[1].start.x_m, 2.6, 1e-9);
  EXPECT_NEAR(ways[1].path.back().arc_m, 0.1, 1e-9);
  for (const geometry::PathPose& at : ways[1].path) EXPECT_EQ(at.travel, geometry::Travel::Reverse);
}

TEST(LeadIn, WhenTheVehicleStandsAtAPoseOfTheLattice_ThenItHasNoWay) {
  const auto ways = lead_ins(straight(41), 0.83, kFrame);  // 3 cm behind 2.8 m
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_EQ(ways[0].path.size(), 1u);
  EXPECT_NEAR(ways[0].start.x_m, 2.8, 1e-9);
}

TEST(LeadIn, WhenThePathEndsBeforeTheNextPoseOfTheLattice_ThenOnlyTheWayBackIsLeft) {
  const auto ways = lead_ins(straight(16), 0.7, kFrame);  // ends at 2.75 m
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_NEAR(ways[0].start.x_m, 2.6, 1e-9);
}

TEST(LeadIn, WhenAHeadingIsNoneOfTheLattice_ThenThePoseIsNotOnIt) {
  EXPECT_TRUE(on_lattice({2.0, 4.0, 0.0}, kFrame));
  EXPECT_FALSE(on_lattice({2.0, 4.0, 0.1}, kFrame));
  EXPECT_FALSE(on_lattice({2.05, 4.0, 0.0}, kFrame));
}

TEST(LeadIn, WhenSomethingStandsOnTheWay_ThenItIsNotFree) {
  const geometry::Footprint outline{.front_m = 1.0, .rear_m = 1.0, .half_width_m = 0.5};
  OccupancyGrid map(kFrame);
  EXPECT_TRUE(is_free(straight(41), outline, map));
  map.set(kFrame.cell_at({4.9, 4.1}), true);
  EXPECT_FALSE(is_free(straight(41), outline, map));
  EXPECT_TRUE(is_free(straight(10), outline, map));
}

}  // namespace
}  // namespace stepwright::fleet
