#include "supervisor/geometry/box_pairs.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace stepwright::geometry {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs compare_all(const std::vector<Box>& boxes, const std::vector<std::uint32_t>& groups) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t k = i + 1; k < boxes.size(); ++k) {
      const Box &a = boxes[i], &b = boxes[k];
      if (groups[i] != groups[k] && a.low.x_m < b.high.x_m && b.low.x_m < a.high.x_m &&
          a.low.y_m < b.high.y_m && b.low.y_m < a.high.y_m) {
        pairs.emplace_back(i, k);
      }
    }
  }
  return pairs;
}

TEST(BoxPairs, Overlapping_WhenBoxesAreRandom_ThenTheyAreThoseOfAllComparisons) {
  std::mt19937 random(1);
  std::size_t found = 0;
  for (int round = 0; round < 100; ++round) {
    // Places on a coarse raster touch often; some boxes are much larger than others, some far away.
    std::uniform_int_distribution<int> place(-20, 20), extent(1, round % 3 == 0 ? 30 : 4), group(0, 5);
    std::vector<Box> boxes;
    std::vector<std::uint32_t> groups;
    for (int k = 0; k < (round % 2 == 0 ? 60 : 240); ++k) {  // without and with the grid
      const double away_m = k == 7 ? 1e5 : 0.0;
      const Point low{place(random) + away_m, static_cast<double>(place(random))};
      boxes.push_back(
          {low, low + Point{static_cast<double>(extent(random)), static_cast<double>(extent(random))}});
      groups.push_back(static_cast<std::uint32_t>(group(random)));
    }
    const Pairs pairs = overlapping_boxes(boxes, groups);
    found += pairs.size();
    ASSERT_EQ(pairs, compare_all(boxes, groups)) << round;
  }
  EXPECT_GT(found, 1000u);
}

TEST(BoxPairs, Overlapping_WhenThereAreNoneOrTheyHaveNoSize_ThenNoPairs) {
  EXPECT_TRUE(overlapping_boxes({}, {}).empty());
  const std::vector<Box> points = {{{1, 1}, {1, 1}}, {{1, 1}, {1, 1}}};
  const std::vector<std::uint32_t> groups = {0, 1};
  EXPECT_TRUE(overlapping_boxes(points, groups).empty());
}

}  // namespace
}  // namespace stepwright::geometry
