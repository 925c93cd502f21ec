#include "tests/support/fleet/floor_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/support/fleet/split_mix.h"

namespace stepwright::support {

namespace {

using fleet::Cell;
using fleet::OccupancyGrid;
using geometry::Point;

void carve_disc(OccupancyGrid& grid, Point middle, double radius_m) {
  const Cell low = grid.frame().cell_at(middle - Point{radius_m, radius_m});
  const Cell high = grid.frame().cell_at(middle + Point{radius_m, radius_m});
  const double half = 0.5 * grid.frame().resolution_m;
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      const Point cell = grid.frame().corner({column, row}) + Point{half, half};
      if (grid.contains({column, row}) && distance(cell, middle) <= radius_m) grid.set({column, row}, false);
    }
  }
}

void carve_tunnel(OccupancyGrid& grid, SplitMix64& random, Point from, Point to) {
  constexpr double kStep_m = 0.8;
  const int steps = static_cast<int>(distance(from, to) / kStep_m) + 1;
  for (int k = 0; k <= steps; ++k) {
    const Point middle = from + (static_cast<double>(k) / steps) * (to - from);
    const Point wobble{random.between(-0.3, 0.3), random.between(-0.3, 0.3)};
    carve_disc(grid, middle + wobble, random.between(2.9, 3.5));
  }
}

void block_rectangle(OccupancyGrid& grid, Point low, Point high) {
  const Point inset{1e-6, 1e-6};
  const Cell first = grid.frame().cell_at(low + inset);
  const Cell last = grid.frame().cell_at(high - inset);
  for (int row = first.row; row <= last.row; ++row) {
    for (int column = first.column; column <= last.column; ++column) grid.set({column, row}, true);
  }
}

}  // namespace

DrawnFloor draw_mine(std::uint64_t seed) {
  constexpr int kColumns = 5;
  constexpr int kRows = 3;
  constexpr double kStub_m = 9.0;
  SplitMix64 random(seed);
  DrawnFloor mine{OccupancyGrid({.resolution_m = 0.2, .origin = {0, 0}, .columns = 600, .rows = 400}, true),
                  {}};
  std::array<std::array<Point, kColumns>, kRows> junctions;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      junctions[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = {
          16.0 + 22.0 * column + random.between(-3.0, 3.0), 16.0 + 24.0 * row + random.between(-3.0, 3.0)};
    }
  }
  const auto junction = [&](int column, int row) {
    return junctions[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const bool border = row == 0 || row == kRows - 1;
      // The middle level has gaps, so that some ways lead around.
      if (column + 1 < kColumns && (border || column % 2 == 0)) {
        carve_tunnel(mine.grid, random, junction(column, row), junction(column + 1, row));
      }
      if (row + 1 < kRows) carve_tunnel(mine.grid, random, junction(column, row), junction(column, row + 1));
    }
  }
  for (int column = 0; column < kColumns; ++column) {
    for (const bool top : {false, true}) {
      const Point mouth = junction(column, top ? kRows - 1 : 0);
      const double slant = random.between(-0.4, 0.4);
      const double heading = (top ? 0.5 : -0.5) * std::numbers::pi + slant;
      const Point inwards{std::cos(heading), std::sin(heading)};
      const Point end = mouth + kStub_m * inwards;
      carve_tunnel(mine.grid, random, mouth, end);
      const Point stand = end - 0.8 * inwards;
      mine.stations.push_back(
          {stand.x_m, stand.y_m, std::remainder(heading + std::numbers::pi, 2.0 * std::numbers::pi)});
    }
  }
  return mine;
}

std::vector<DrawnTask> mine_tasks(const DrawnFloor& mine) {
  constexpr std::array<std::size_t, 7> kGoals = {7, 4, 9, 6, 1, 8, 3};
  std::vector<DrawnTask> tasks;
  for (std::size_t k = 0; k < kGoals.size(); ++k) {
    geometry::Pose goal = mine.stations[kGoals[k]];
    goal.heading_rad = std::remainder(goal.heading_rad + std::numbers::pi, 2.0 * std::numbers::pi);
    tasks.push_back({mine.stations[k], goal});
  }
  return tasks;
}

DrawnFloor draw_warehouse(std::uint64_t seed) {
  constexpr double kRack_m = 16.0;
  constexpr double kDepth_m = 2.0;
  constexpr double kAisle_m = 4.0;
  constexpr double kCross_m = 6.0;
  SplitMix64 random(seed);
  DrawnFloor floor{OccupancyGrid({.resolution_m = 0.2, .origin = {0, 0}, .columns = 400, .rows = 300}), {}};
  for (double y = kCross_m; y + kDepth_m + kCross_m <= 60.0; y += kDepth_m + kAisle_m) {
    for (double x = kCross_m; x + kRack_m + kCross_m <= 80.0; x += kRack_m + kCross_m) {
      if (random.below(8) != 0) block_rectangle(floor.grid, {x, y}, {x + kRack_m, y + kDepth_m});
      floor.stations.push_back(
          {x + 0.5 * kRack_m, y - 0.5 * kAisle_m, random.below(2) == 0 ? 0.0 : std::numbers::pi});
    }
  }
  return floor;
}

DrawnHall draw_hall() {
  constexpr double kWall_m = 6.0;
  constexpr double kWidth_m = 100.0, kHeight_m = 66.0;
  constexpr double kNiche_m = 2.8;
  constexpr double kDeep_m = 2.0;  // of the reference point behind the niche's end
  constexpr std::array<std::pair<double, double>, 3> kBlocks = {{{13.0, 33.0}, {39.0, 61.0}, {67.0, 87.0}}};
  DrawnHall hall{
      OccupancyGrid({.resolution_m = 0.2, .origin = {0, 0}, .columns = 500, .rows = 330}), {}, {}, {}};
  OccupancyGrid& grid = hall.grid;
  block_rectangle(grid, {0, 0}, {kWidth_m, kWall_m});
  block_rectangle(grid, {0, kHeight_m - kWall_m}, {kWidth_m, kHeight_m});
  block_rectangle(grid, {0, 0}, {kWall_m, kHeight_m});
  block_rectangle(grid, {kWidth_m - kWall_m, 0}, {kWidth_m, kHeight_m});
  const auto carve = [&](Point low, Point high) {
    for (int row = grid.frame().cell_at(low).row; row <= grid.frame().cell_at(high).row; ++row) {
      for (int c = grid.frame().cell_at(low).column; c <= grid.frame().cell_at(high).column; ++c)
        grid.set({c, row}, false);
    }
  };
  constexpr double kIn = 0.1;  // the middle of the outermost cells
  for (int k = 0; k < 25; ++k) {
    const double x = 10.0 + 3.2 * ((k * 7) % 25);
    carve({x - 0.5 * kNiche_m + kIn, 0.2 + kIn}, {x + 0.5 * kNiche_m - kIn, kWall_m + kIn});
    carve({x - 0.5 * kNiche_m + kIn, kHeight_m - kWall_m - kIn},
          {x + 0.5 * kNiche_m - kIn, kHeight_m - 0.2 - kIn});
    hall.bays.push_back({x, 0.2 + kDeep_m, -0.5 * std::numbers::pi});
    hall.bays.push_back({x, kHeight_m - 0.2 - kDeep_m, 0.5 * std::numbers::pi});
  }
  for (int k = 0; k < 6; ++k) {
    const double y = 15.0 + 7.2 * k;
    carve({0.2 + kIn, y - 0.5 * kNiche_m + kIn}, {kWall_m + kIn, y + 0.5 * kNiche_m - kIn});
    carve({kWidth_m - kWall_m - kIn, y - 0.5 * kNiche_m + kIn},
          {kWidth_m - 0.2 - kIn, y + 0.5 * kNiche_m - kIn});
    hall.docks.push_back({0.2 + kDeep_m, y, std::numbers::pi});
    hall.docks.push_back({kWidth_m - 0.2 - kDeep_m, y, 0.0});
  }
  for (const auto& [left, right] : kBlocks) {
    for (int row = 0; row < 7; ++row)
      block_rectangle(grid, {left, 14.0 + 6.0 * row}, {right, 16.0 + 6.0 * row});
    for (int aisle = 0; aisle < 6; ++aisle) {
      const double middle = std::round(0.5 * (left + right) / 0.2) * 0.2;
      hall.shelves.push_back({middle, 18.0 + 6.0 * aisle, aisle % 2 == 0 ? 0.0 : std::numbers::pi});
    }
  }
  return hall;
}

}  // namespace stepwright::support
