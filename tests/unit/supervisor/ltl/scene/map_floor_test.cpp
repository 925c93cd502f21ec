#include "supervisor/ltl/scene/map_floor.h"

#include <gtest/gtest.h>

#include <random>

#include "supervisor/ltl/scene/places.h"

namespace stepwright::ltl {
namespace {

TEST(MapFloor, WhenCellsAreRandom_ThenRectanglesCoverTheBlockedOnesOnce) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 dice(seed);
    fleet::OccupancyGrid grid({.resolution_m = 0.5, .origin = {-3.0, 2.0}, .columns = 17, .rows = 13});
    for (std::int32_t row = 0; row < 13; ++row)
      for (std::int32_t column = 0; column < 17; ++column) grid.set({column, row}, dice() % 3 == 0);
    const Floor floor = floor_of(grid, "map.yaml");
    EXPECT_EQ(floor.border.ring[2], (geometry::Point{-3.0 + 17 * 0.5, 2.0 + 13 * 0.5}));
    for (std::int32_t row = 0; row < 13; ++row) {
      for (std::int32_t column = 0; column < 17; ++column) {
        const geometry::Point middle = grid.frame().corner({column, row}) + geometry::Point{0.25, 0.25};
        int covered = 0;
        for (const Area& each : floor.obstacles) covered += inside(each.ring, middle) ? 1 : 0;
        EXPECT_EQ(covered, grid.blocked({column, row}) ? 1 : 0) << seed << ": " << column << ", " << row;
      }
    }
  }
}

TEST(MapFloor, WhenABlockIsARectangle_ThenItIsOneObstacle) {
  fleet::OccupancyGrid grid({.resolution_m = 1.0, .origin = {0, 0}, .columns = 100, .rows = 100});
  EXPECT_TRUE(floor_of(grid, "map.yaml").obstacles.empty());
  for (std::int32_t row = 20; row < 60; ++row)
    for (std::int32_t column = 10; column < 90; ++column) grid.set({column, row}, true);
  const Floor floor = floor_of(grid, "map.yaml");
  ASSERT_EQ(floor.obstacles.size(), 1u);
  EXPECT_EQ(floor.obstacles[0].name, "cells at 10, 20");
  EXPECT_EQ(floor.obstacles[0].where.file, "map.yaml");
}

}  // namespace
}  // namespace stepwright::ltl
