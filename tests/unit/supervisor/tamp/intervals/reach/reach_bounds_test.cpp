#include "supervisor/tamp/intervals/reach/reach_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "supervisor/tamp/intervals/reach/column_arm.h"

namespace stepwright::tamp {
namespace {

constexpr ColumnArm kArm{.x_m = 0.1,
                         .y_m = -0.2,
                         .z_m = 0.5,
                         .least_m = 0.2,
                         .easy_m = 0.4,
                         .most_m = 0.8,
                         .lean_rad = 0.3,
                         .turn_rad = 1.5,
                         .flip_rad = 0.4};

std::int64_t random_nm(std::mt19937_64& random, double low_m, double high_m) {
  return nanometres_of(low_m + (high_m - low_m) * static_cast<double>(random() >> 11) * 0x1p-53);
}

TEST(ReachGrid, WhenPositionsAreNegative_ThenEachIsInOneRow) {
  const ReachGrid grid{{-100, 0, 50}, {30, 10, 7}, {5, 4, 3}};
  EXPECT_EQ(grid.row(0, -101), -1);
  EXPECT_EQ(grid.row(0, -100), 0);
  EXPECT_EQ(grid.row(0, -71), 0);
  EXPECT_EQ(grid.row(0, -70), 1);
  EXPECT_EQ(grid.span(0, 1), (Span{-70, -41}));
  EXPECT_EQ(grid.extent(2), (Span{50, 70}));
  EXPECT_EQ(grid.size(), 60u);
}

TEST(ReachTable, WhenPosesAreReachable_ThenNoneIsOutsideOfTheBounds) {
  const ReachTable table = reach_table(kArm, 0.05);
  std::mt19937_64 random(11);
  std::size_t reachable = 0, outside = 0;
  for (int k = 0; k < 100'000; ++k) {
    const Point3 at{random_nm(random, -0.8, 1.0), random_nm(random, -1.1, 0.7), random_nm(random, -0.4, 1.4)};
    const auto angle = static_cast<Angle>(random());
    if (!arcs_at(kArm, at).contains(angle)) continue;
    ++reachable;
    ArcSet bounds;
    bounds.add(table.arcs_at(at));
    if (!bounds.contains(angle)) ++outside;
  }
  EXPECT_GT(reachable, 5'000u);
  EXPECT_EQ(outside, 0u);
}

TEST(ReachTable, WhenBoxesAreLarge_ThenCoarseCellsHoldWhatTheirPartsHave) {
  const ReachTable table = reach_table(kArm, 0.05);
  ASSERT_NE(table.coarse(), nullptr);
  const ReachGrid &fine = table.grid(), &coarse = table.coarse()->grid();
  for (std::int64_t z = 0; z < fine.cells[2]; z += 3) {
    for (std::int64_t y = 0; y < fine.cells[1]; ++y) {
      for (std::int64_t x = 0; x < fine.cells[0]; ++x) {
        ArcSet large;
        large.add(table.coarse()->arcs(coarse.index(x / 4, y / 4, z / 4)));
        for (const Arc arc : table.arcs(fine.index(x, y, z))) ASSERT_TRUE(large.contains(arc));
      }
    }
  }
  const Box everywhere{Span{-2'000'000'000, 2'000'000'000}, Span{-2'000'000'000, 2'000'000'000},
                       Span{-2'000'000'000, 2'000'000'000}};
  EXPECT_TRUE(table.arcs_over(everywhere).is_full());
  EXPECT_TRUE(table.arcs_at({3'000'000'000, 0, 0}).empty());
}

TEST(ReachTable, WhenAHandAlsoReachesTurnedAround_ThenThereAreTwoRanges) {
  const ReachTable table = reach_table(kArm, 0.05);
  ArcSet bounds;
  bounds.add(table.arcs_at({nanometres_of(0.1 + 0.35), nanometres_of(-0.2), nanometres_of(0.5)}));
  EXPECT_EQ(bounds.size(), 2u);
  EXPECT_TRUE(bounds.contains(angle_of(0.3)));
  EXPECT_TRUE(bounds.contains(angle_of(0.3 + 3.14159)));
  EXPECT_FALSE(bounds.contains(angle_of(0.3 + 2.2)));
}

}  // namespace
}  // namespace stepwright::tamp
