#include "supervisor/fleet/lattice/swept_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

namespace stepwright::fleet {
namespace {

using Cells = std::set<std::pair<int, int>>;

Cells cells_of(const SweptMotion& motion) {
  Cells cells;
  for (const RowSpan& span : motion.spans) {
    for (int column = span.first; column <= span.last; ++column) cells.insert({column, span.row});
  }
  return cells;
}

geometry::Footprint grown(geometry::Footprint footprint, double by_m) {
  return {footprint.front_m + by_m, footprint.rear_m + by_m, footprint.half_width_m + by_m};
}

// All cells that the outline overlaps at many poses of the motion, each judged by separating axes.
Cells sampled(const geometry::Footprint& footprint, const MotionPrimitive& primitive, double cell_m,
              int samples) {
  const GridFrame frame{.resolution_m = cell_m, .origin = {}, .columns = 1, .rows = 1};
  Cells cells;
  for (int k = 0; k <= samples; ++k) {
    const auto outline = footprint_at(pose_along(primitive, primitive.length_m * k / samples), footprint);
    const Cell low = frame.cell_at(outline.bounds().low);
    const Cell high = frame.cell_at(outline.bounds().high);
    for (int row = low.row; row <= high.row; ++row) {
      for (int column = low.column; column <= high.column; ++column) {
        if (cells.contains({column, row})) continue;
        if (overlaps(outline, cell_square(frame, {column, row}))) cells.insert({column, row});
      }
    }
  }
  return cells;
}

class Swept : public ::testing::TestWithParam<int> {
 protected:
  VehicleModel vehicle_{.front_m = 2.1, .rear_m = 1.3, .width_m = 1.37};
  PrimitiveSet primitives_{vehicle_, {}};
  SweptCells cells_{vehicle_, primitives_, GetParam()};
  double cell_m_ = 0.2 / GetParam();
};

TEST_P(Swept, OfPrimitive_WhenSampledDensely_ThenEveryCellTouchedIsInTheSetAndFewOthers) {
  constexpr int kSamples = 120;
  for (std::size_t k = 0; k < primitives_.all().size(); k += 11) {
    const MotionPrimitive& primitive = primitives_.all()[k];
    const Cells set = cells_of(cells_.of_primitive(k));
    EXPECT_TRUE(
        std::ranges::includes(set, sampled(grown(vehicle_.footprint(), SweptCells::clearance_m(vehicle_)),
                                           primitive, cell_m_, kSamples)))
        << k;
    // Between two samples a corner moves no more than twice as far as the reference point.
    const double between_m = primitive.length_m / kSamples;
    const Cells near =
        sampled(grown(vehicle_.footprint(), SweptCells::clearance_m(vehicle_) + 0.011 + between_m), primitive,
                cell_m_, kSamples);
    EXPECT_TRUE(std::ranges::includes(near, set)) << k;
  }
}

TEST_P(Swept, OfHeading_WhenStanding_ThenTheOutlineIsCovered) {
  for (int heading = 0; heading < kHeadings; ++heading) {
    MotionPrimitive stand;
    stand.start_heading = heading;
    const Cells set = cells_of(cells_.of_heading(heading));
    EXPECT_TRUE(std::ranges::includes(set, sampled(vehicle_.footprint(), stand, cell_m_, 1)));
    EXPECT_TRUE(std::ranges::includes(
        sampled(grown(vehicle_.footprint(), SweptCells::clearance_m(vehicle_) + 0.001), stand, cell_m_, 1),
        set));
  }
}

// Discs and reach only shorten the look at the cells.
TEST_P(Swept, Free_WhenObstaclesAreRandom_ThenEqualsALookAtEveryCell) {
  std::mt19937 random(31);
  OccupancyGrid grid(
      {.resolution_m = cell_m_, .origin = {}, .columns = 90 * GetParam(), .rows = 80 * GetParam()});
  const auto below = [&](int bound) { return static_cast<int>(random() % static_cast<unsigned>(bound)); };
  for (int k = 0; k < 6; ++k) grid.set({below(grid.frame().columns), below(grid.frame().rows)}, true);
  const DistanceField clearance(grid);
  int free = 0;
  constexpr int kRounds = 4000;
  for (int round = 0; round < kRounds; ++round) {
    const Cell cell{GetParam() * below(91), GetParam() * below(81)};
    const SweptMotion& motion = cells_.of_primitive(random() % primitives_.all().size());
    const Cells set = cells_of(motion);
    const bool expected = std::ranges::none_of(set, [&](const auto& c) {
      return grid.blocked({cell.column + c.first, cell.row + c.second});
    });
    EXPECT_EQ(SweptCells::free(grid, clearance, motion, cell), expected);
    free += expected ? 1 : 0;
  }
  EXPECT_GT(free, kRounds / 8);
  EXPECT_LT(free, kRounds - kRounds / 8);
}

INSTANTIATE_TEST_SUITE_P(CellsPerStep, Swept, ::testing::Values(1, 2));

}  // namespace
}  // namespace stepwright::fleet
