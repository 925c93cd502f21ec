#include "supervisor/map/occupancy_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "supervisor/map/row_span.h"

namespace stepwright::fleet {
namespace {

using geometry::ConvexPolygon;
using geometry::Point;

OccupancyGrid random_grid(std::mt19937& random, int columns, int rows, int one_in) {
  OccupancyGrid grid({.resolution_m = 0.5, .origin = {-3.0, 2.0}, .columns = columns, .rows = rows});
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (random() % static_cast<unsigned>(one_in) == 0) grid.set({column, row}, true);
    }
  }
  return grid;
}

TEST(OccupancyGrid, AnyBlocked_WhenRunsAreRandom_ThenEqualsALookAtEveryCell) {
  std::mt19937 random(3);
  const OccupancyGrid grid = random_grid(random, 200, 4, 60);
  int blocked = 0;
  for (int round = 0; round < 4000; ++round) {
    const int row = static_cast<int>(random() % 6) - 1;
    const int first = static_cast<int>(random() % 210) - 5;
    const int last = first + static_cast<int>(random() % 140) - 1;
    bool any = false;
    for (int column = first; column <= last; ++column) any = any || grid.blocked({column, row});
    EXPECT_EQ(grid.any_blocked(row, first, last), any) << row << " " << first << " " << last;
    blocked += any ? 1 : 0;
  }
  EXPECT_GT(blocked, 1000);
  EXPECT_LT(blocked, 3500);
}

TEST(OccupancyGrid, Blocked_WhenTheCellLiesOutside_ThenYes) {
  const OccupancyGrid grid({.resolution_m = 0.2, .origin = {0, 0}, .columns = 3, .rows = 2});
  EXPECT_FALSE(grid.blocked({2, 1}));
  EXPECT_TRUE(grid.blocked({3, 1}));
  EXPECT_TRUE(grid.blocked({-1, 0}));
  EXPECT_TRUE(grid.blocked({0, 2}));
  EXPECT_EQ(grid.frame().cell_at({1e300, -1e300}).column, 1'000'000);
}

// The spans are held against the separating axes of each cell's square.
TEST(RowSpan, CoveredSpans_WhenPolygonsAreRandom_ThenHoldTheCellsThatOverlap) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-2.5, 6.0);
  std::uniform_real_distribution<double> offset(-1.5, 1.5);
  const GridFrame frame{.resolution_m = 0.5, .origin = {-3.0, -3.0}, .columns = 24, .rows = 24};
  for (int round = 0; round < 200; ++round) {
    const Point middle{place(random), place(random)};
    std::vector<Point> points;
    for (int k = 0; k < 6; ++k) points.push_back(middle + Point{offset(random), offset(random)});
    const auto polygon = ConvexPolygon::hull(points).value();
    OccupancyGrid covered(frame);
    for (const RowSpan& span : covered_spans(polygon, frame)) {
      for (int column = span.first; column <= span.last; ++column) {
        if (covered.contains({column, span.row})) covered.set({column, span.row}, true);
      }
    }
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        const Cell cell{column, row};
        EXPECT_EQ(covered.blocked(cell), overlaps(polygon, cell_square(frame, cell)));
      }
    }
  }
}

TEST(RowSpan, CoveredSpans_WhenSidesLieOnTheGrid_ThenNeighboursThatAreTouchedAreLeftOut) {
  const GridFrame frame{.resolution_m = 0.5, .origin = {0, 0}, .columns = 10, .rows = 10};
  const std::array<Point, 4> corners = {Point{1.0, 1.5}, {2.0, 1.5}, {2.0, 2.5}, {1.0, 2.5}};
  const auto spans = covered_spans(ConvexPolygon::hull(corners).value(), frame);
  EXPECT_EQ(spans, (std::vector<RowSpan>{{3, 2, 3}, {4, 2, 3}}));
}

TEST(RowSpan, MeetsObstacle_WhenTheBoxLeavesTheMap_ThenYes) {
  OccupancyGrid grid({.resolution_m = 0.2, .origin = {0, 0}, .columns = 50, .rows = 50});
  const geometry::Footprint vehicle{.front_m = 2.9, .rear_m = 1.1, .half_width_m = 0.7};
  EXPECT_FALSE(meets_obstacle(grid, footprint_at({5.0, 5.0, 0.3}, vehicle)));
  EXPECT_TRUE(meets_obstacle(grid, footprint_at({8.0, 5.0, 0.3}, vehicle)));
  grid.set({30, 25}, true);
  EXPECT_TRUE(meets_obstacle(grid, footprint_at({5.0, 5.0, 0.0}, vehicle)));
  EXPECT_FALSE(meets_obstacle(grid, footprint_at({5.0, 6.0, 0.0}, vehicle)));
}

}  // namespace
}  // namespace stepwright::fleet
