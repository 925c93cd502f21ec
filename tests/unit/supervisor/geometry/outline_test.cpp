#include "supervisor/geometry/outline.h"

#include <gtest/gtest.h>

#include <vector>

#include "supervisor/geometry/box.h"

namespace stepwright::geometry {
namespace {

TEST(Outline, WhenAPointIsBesideOrBehindASide_ThenTheNearestOneIsOnIt) {
  EXPECT_EQ(nearest_on_side({0, 0}, {4, 0}, {1, 3}), (Point{1, 0}));
  EXPECT_EQ(nearest_on_side({0, 0}, {4, 0}, {9, 3}), (Point{4, 0}));
  EXPECT_EQ(nearest_on_side({2, 2}, {2, 2}, {9, 3}), (Point{2, 2}));
  EXPECT_DOUBLE_EQ(distance_to_side({1, 3}, {0, 0}, {4, 0}), 3.0);
  EXPECT_DOUBLE_EQ(distance_to_side({7, 4}, {0, 0}, {4, 0}), 5.0);
}

TEST(Outline, WhenItGoesRound_ThenTheAreaHasTheSignOfTheOrder) {
  const std::vector<Point> ring = {{1, 1}, {3, 1}, {3, 4}};
  EXPECT_DOUBLE_EQ(signed_area_m2(ring), 3.0);
  EXPECT_DOUBLE_EQ(signed_area_m2(std::vector<Point>(ring.rbegin(), ring.rend())), -3.0);
}

TEST(Box, WhenPointsExtendIt_ThenAllAreWithin) {
  const Box box = bounds_of(std::vector<Point>{{1, -2}, {-3, 4}, {0, 0}});
  EXPECT_EQ(box.low, (Point{-3, -2}));
  EXPECT_EQ(box.high, (Point{1, 4}));
  EXPECT_GT(bounds_of({}).low.x_m, bounds_of({}).high.x_m);
}

}  // namespace
}  // namespace stepwright::geometry
