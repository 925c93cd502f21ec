#include "supervisor/map/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace stepwright::fleet {
namespace {

double gap(double value, double low, double high) {
  return std::max({low - value, value - high, 0.0});
}

// To the nearest blocked square or to the border, by looking at all of them.
double distance_by_hand(const OccupancyGrid& grid, Cell corner) {
  const GridFrame& frame = grid.frame();
  double cells =
      std::min({corner.column, corner.row, frame.columns - corner.column, frame.rows - corner.row});
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      if (!grid.blocked({column, row})) continue;
      const double across = gap(corner.column, column, column + 1);
      const double along = gap(corner.row, row, row + 1);
      cells = std::min(cells, std::hypot(across, along));
    }
  }
  return cells * frame.resolution_m;
}

void expect_exact(const OccupancyGrid& grid) {
  const DistanceField field(grid);
  for (int row = 0; row <= grid.frame().rows; ++row) {
    for (int column = 0; column <= grid.frame().columns; ++column) {
      EXPECT_NEAR(field.at_corner({column, row}), distance_by_hand(grid, {column, row}), 1e-5)
          << column << " " << row;
    }
  }
}

TEST(DistanceField, AtCorner_WhenObstaclesAreRandom_ThenItIsTheDistanceToTheNearestSquare) {
  std::mt19937 random(9);
  for (int round = 0; round < 12; ++round) {
    const GridFrame frame{.resolution_m = 0.2,
                          .origin = {4.0, -1.0},
                          .columns = 2 + static_cast<int>(random() % 40),
                          .rows = 2 + static_cast<int>(random() % 40)};
    OccupancyGrid grid(frame);
    for (int k = 0; k < round; ++k) {
      grid.set({static_cast<int>(random() % static_cast<unsigned>(frame.columns)),
                static_cast<int>(random() % static_cast<unsigned>(frame.rows))},
               true);
    }
    expect_exact(grid);
  }
}

TEST(DistanceField, AtCorner_WhenAllIsBlocked_ThenZero) {
  expect_exact(OccupancyGrid({.resolution_m = 1.0, .origin = {0, 0}, .columns = 5, .rows = 7}, true));
}

}  // namespace
}  // namespace stepwright::fleet
