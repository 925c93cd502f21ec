#include "supervisor/ltl/bound/sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;
using testing::Rectangle;
using testing::Squares;

// Whether the straight way comes into a rectangle's inside: the part of it that is left between its sides
// (C. Liang, B. Barsky 1984), for whole metres.
bool enters(const Rectangle& box, Point a, Point b) {
  double from = 0.0, to = 1.0;
  const auto keep = [&](double at, double way, double low, double high) {
    if (way == 0.0) return at > low && at < high;
    const double one = (low - at) / way, other = (high - at) / way;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
    return true;
  };
  return keep(a.x_m, b.x_m - a.x_m, box.left, box.right) && keep(a.y_m, b.y_m - a.y_m, box.low, box.high) &&
         to - from > 1e-9;
}

// Whether a way along the metres has walls, or that place, on both sides of it somewhere.
bool leads_between(const Squares& squares, Point a, Point b, const Rectangle& place = {0, 0, 0, 0}) {
  if ((a.x_m != b.x_m) == (a.y_m != b.y_m)) return false;
  const auto wall = [&](int x, int y) {
    return x < 0 || y < 0 || x >= testing::kSize || y >= testing::kSize || !squares.is_free(x, y) ||
           place.has(x, y);
  };
  const auto [left, right] = std::minmax(static_cast<int>(a.x_m), static_cast<int>(b.x_m));
  const auto [low, high] = std::minmax(static_cast<int>(a.y_m), static_cast<int>(b.y_m));
  for (int x = left; x < right; ++x)
    if (wall(x, low) && wall(x, low - 1)) return true;
  for (int y = low; y < high; ++y)
    if (wall(left, y) && wall(left - 1, y)) return true;
  return false;
}

TEST(Sight, WhenPointsAreCornersOfSquares_ThenItIsThatOfEachRectangle) {
  std::size_t seen = 0, blocked = 0, through = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const Squares squares = testing::random_squares(seed);
    const Sight sight(squares.floor());
    std::mt19937 dice(seed);
    // Ends on the whole metres that are no inner points of an obstacle: touching is the rule.
    const auto point = [&] {
      while (true) {
        const Point at{static_cast<double>(dice() % 21), static_cast<double>(dice() % 21)};
        if (std::ranges::none_of(squares.obstacles, [&](const Rectangle& each) {
              return at.x_m > each.left && at.x_m < each.right && at.y_m > each.low && at.y_m < each.high;
            }))
          return at;
      }
    };
    for (int n = 0; n < 200; ++n) {
      const Point a = point(), b = point();
      const bool free = std::ranges::none_of(squares.obstacles,
                                             [&](const Rectangle& each) { return enters(each, a, b); }) &&
                        !leads_between(squares, a, b);
      const auto answer = sight.through(a, b);
      ASSERT_EQ(answer.has_value(), free)
          << "seed " << seed << ": " << a.x_m << ", " << a.y_m << " to " << b.x_m << ", " << b.y_m;
      ++(free ? seen : blocked);
      if (!free) continue;
      for (std::size_t k = 0; k < squares.propositions.size(); ++k) {
        const Rectangle& place = squares.propositions[k];
        const bool crossed = (*answer >> k & 1) != 0;
        // What lies within as a whole may count or not: nothing closes a place to who is in it.
        const bool within = std::min(a.x_m, b.x_m) > place.left && std::max(a.x_m, b.x_m) < place.right &&
                            std::min(a.y_m, b.y_m) > place.low && std::max(a.y_m, b.y_m) < place.high;
        if (within) continue;
        EXPECT_EQ(crossed, (enters(place, a, b) && a != b) || leads_between(squares, a, b, place))
            << "seed " << seed << ", place " << k;
        through += crossed ? 1 : 0;
      }
    }
  }
  EXPECT_GT(seen, 2000u);
  EXPECT_GT(blocked, 2000u);
  EXPECT_GT(through, 500u);
}

TEST(Sight, WhenAWayLeavesTheBorder_ThenItIsBlocked) {
  // An L: the straight way between its ends leads through what is not there.
  Floor floor;
  floor.border = {"border", {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}}, {}};
  const Sight sight(floor);
  EXPECT_FALSE(sight.through({9, 3}, {3, 9}));
  EXPECT_TRUE(sight.through({9, 3}, {4, 4}));
  EXPECT_TRUE(sight.through({4, 4}, {3, 9}));
  EXPECT_TRUE(sight.through({0, 0}, {10, 0})) << "along the border";
  EXPECT_FALSE(sight.through({10, 4}, {4, 10}));
  ASSERT_EQ(sight.corners().size(), 1u);
  EXPECT_EQ(sight.corners()[0], (Point{4, 4}));
}

}  // namespace
}  // namespace stepwright::ltl
