#pragma once

// A small vehicle on small floors, which keeps plain Dijkstra quick: what tests of paths share.

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <random>

#include "supervisor/fleet/lattice/path_planner.h"
#include "tests/support/fleet/exact_outline.h"
#include "tests/unit/supervisor/fleet/lattice/plain_dijkstra.h"

namespace stepwright::fleet {

inline const VehicleModel kCart{
    .wheelbase_m = 0.6, .min_turning_radius_m = 1.0, .front_m = 0.5, .rear_m = 0.5, .width_m = 0.6};

class CartTest : public ::testing::Test {
 protected:
  static constexpr int kColumns = 40;
  static constexpr int kRows = 30;

  OccupancyGrid random_floor(int obstacles, int cells_per_step = 1) {
    OccupancyGrid grid({.resolution_m = 0.2 / cells_per_step,
                        .origin = {-3.0, 1.0},
                        .columns = kColumns * cells_per_step,
                        .rows = kRows * cells_per_step});
    for (int k = 0; k < obstacles; ++k)
      grid.set({below(grid.frame().columns), below(grid.frame().rows)}, true);
    return grid;
  }
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }
  PlainPose random_pose() { return {below(kColumns + 1), below(kRows + 1), below(kHeadings)}; }
  static geometry::Pose pose_of(const OccupancyGrid& grid, const PlainPose& pose) {
    const auto [x, y, heading] = pose;
    return {grid.frame().origin.x_m + 0.2 * x, grid.frame().origin.y_m + 0.2 * y, heading_rad(heading)};
  }
  static bool stands(const OccupancyGrid& grid, const SweptCells& cells, const PlainPose& pose) {
    const auto [x, y, heading] = pose;
    const int scale = cells.cells_per_step();
    for (const RowSpan& span : cells.of_heading(heading).spans) {
      if (grid.any_blocked(y * scale + span.row, x * scale + span.first, x * scale + span.last)) return false;
    }
    return true;
  }
  // The path is what it says: poses follow each other at the distances that it tells, marks name primitives.
  void expect_sound(const OccupancyGrid& grid, const LatticePath& path) {
    EXPECT_EQ(support::first_hit(grid, kCart.footprint(), path.poses), std::nullopt);
    std::uint32_t cost = 0;
    for (const PathMark& mark : path.marks) cost += primitives_.all()[mark.primitive].cost_mm;
    EXPECT_EQ(cost, path.cost_mm);
    for (std::size_t k = 1; k < path.poses.size(); ++k) {
      const double arc_m = path.poses[k].arc_m - path.poses[k - 1].arc_m;
      const double moved_m = distance(path.poses[k].pose.position(), path.poses[k - 1].pose.position());
      EXPECT_GT(arc_m, 0.0);
      EXPECT_LE(arc_m, kPathSample_m + 1e-9);
      EXPECT_LE(moved_m, arc_m + 1e-12);
      EXPECT_GT(moved_m, 0.999 * arc_m);
    }
    EXPECT_NEAR(path.poses.back().arc_m, path.length_m, 1e-9);
  }

  std::mt19937 random_{41};
  PrimitiveSet primitives_{kCart, {.long_straight_m = 0.6}};
  HeuristicTable table_ = HeuristicTable::build(primitives_, {.range_m = 2.0, .margin_m = 2.0});
};

}  // namespace stepwright::fleet
