#include "cell/hmi/wall_outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "supervisor/map/map_file.h"

namespace stepwright::hmi {
namespace {

using fleet::OccupancyGrid;
using Drawn = std::vector<std::string>;  // the top row first; '#' is blocked

OccupancyGrid grid_of(const Drawn& rows) {
  OccupancyGrid grid({.resolution_m = 0.5,
                      .origin = {-1, 2},
                      .columns = static_cast<std::int32_t>(rows.front().size()),
                      .rows = static_cast<std::int32_t>(rows.size())});
  for (std::int32_t row = 0; row < grid.frame().rows; ++row) {
    const std::string& line = rows[rows.size() - 1 - static_cast<std::size_t>(row)];
    for (std::int32_t column = 0; column < grid.frame().columns; ++column) {
      grid.set({column, row}, line[static_cast<std::size_t>(column)] == '#');
    }
  }
  return grid;
}

// What a viewer fills: how many upright sides of lines are to the left of the middle of a cell.
bool is_filled(const protocol::FloorMap& map, std::int32_t column, std::int32_t row) {
  int sides = 0;
  for (const auto& line : map.outlines) {
    std::int32_t x = line.at(0);
    std::int32_t y = line.at(1);
    const auto side = [&](std::int32_t to) {
      if (x <= column && std::min(y, to) <= row && row < std::max(y, to)) ++sides;
      y = to;
    };
    for (std::size_t k = 2; k < line.size(); ++k) {
      if (k % 2 == 0) x += line[k];
      if (k % 2 == 1) side(y + line[k]);
    }
    side(line[1]);
    EXPECT_EQ(x, line[0]);  // the last step is along y alone
  }
  return sides % 2 == 1;
}

void expect_same(const OccupancyGrid& grid, const protocol::FloorMap& map) {
  ASSERT_EQ(map.columns, grid.frame().columns);
  ASSERT_EQ(map.rows, grid.frame().rows);
  for (std::int32_t row = 0; row < map.rows; ++row) {
    for (std::int32_t column = 0; column < map.columns; ++column) {
      ASSERT_EQ(is_filled(map, column, row), grid.blocked({column, row})) << column << " " << row;
    }
  }
}

std::size_t numbers_of(const protocol::FloorMap& map) {
  std::size_t count = 0;
  for (const auto& line : map.outlines) count += line.size();
  return count;
}

TEST(WallOutlines, WhenThereIsOneRack_ThenItIsOneLineOfFiveNumbers) {
  const auto map = outlined(grid_of({".....", ".##..", ".##..", "....."}));
  EXPECT_EQ(map.outlines, (std::vector<std::vector<std::int32_t>>{{1, 1, 2, 2, -2}}));
  EXPECT_EQ(map.low_x_m, -1);
  EXPECT_EQ(map.low_y_m, 2);
  EXPECT_EQ(map.cell_m, 0.5);
}

TEST(WallOutlines, WhenWallsHaveHolesCornersAndEdges_ThenTheLinesFillTheSameCells) {
  for (const Drawn& drawn :
       {Drawn{"####", "#..#", "#.##", "####"}, Drawn{"#.#", ".#.", "#.#"}, Drawn{"...", "..."},
        Drawn{"##", "##"}, Drawn{"##.##", "#.#.#", "##.##"}, Drawn{"#"}}) {
    const OccupancyGrid grid = grid_of(drawn);
    expect_same(grid, outlined(grid));
  }
}

TEST(WallOutlines, WhenCellsAreDrawnByLot_ThenTheLinesFillTheSameCells) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 50; ++trial) {
    OccupancyGrid grid({.resolution_m = 0.2, .origin = {}, .columns = 1 + trial % 13, .rows = 1 + trial % 9});
    for (std::int32_t row = 0; row < grid.frame().rows; ++row) {
      for (std::int32_t column = 0; column < grid.frame().columns; ++column) {
        grid.set({column, row}, random() % 2 == 0);
      }
    }
    expect_same(grid, outlined(grid));
  }
}

TEST(WallOutlines, WhenTheExamplesAreOutlined_ThenTheyAreAFewThousandNumbers) {
  const std::filesystem::path folder = STEPWRIGHT_SOURCE_DIR "/tests/cells/fleet";
  for (const char* name : {"mine.yaml", "warehouse.yaml"}) {
    const OccupancyGrid grid = fleet::read_map(folder / name).value();
    const auto map = outlined(grid);
    EXPECT_LT(numbers_of(map), 15'000u) << name;
    EXPECT_EQ(map.columns, grid.frame().columns) << name;
  }
}

TEST(WallOutlines, WhenThereAreTooManyNumbers_ThenTheMapIsCoarserAndNothingBlockedIsLost) {
  OccupancyGrid grid({.resolution_m = 0.2, .origin = {}, .columns = 101, .rows = 60});
  for (std::int32_t row = 0; row < 60; ++row) {
    for (std::int32_t column = 0; column < 101; ++column) grid.set({column, row}, (row + column) % 2 == 0);
  }
  grid.set({100, 58}, true);
  const auto map = outlined(grid, 500);
  EXPECT_LE(numbers_of(map), 500u);
  EXPECT_EQ(map.columns, 51);
  EXPECT_EQ(map.rows, 30);
  EXPECT_DOUBLE_EQ(map.cell_m, 0.4);
  EXPECT_TRUE(is_filled(map, 50, 29));
  EXPECT_TRUE(is_filled(map, 0, 0));
}

}  // namespace
}  // namespace stepwright::hmi
