#include "supervisor/ltl/regions/single_ring.h"

#include <gtest/gtest.h>

namespace stepwright::ltl {
namespace {

double twice_area(const Ring& ring) {
  double twice = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) twice += cross(ring[k], ring[(k + 1) % ring.size()]);
  return twice;
}

const Ring kBox = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(SingleRing, Hole_WhenItLiesApart_ThenIsReachedOverABridge) {
  const Ring ring = single_ring({kBox, {{4, 4}, {6, 4}, {6, 6}, {4, 6}}});
  EXPECT_EQ(ring.size(), 4U + 4U + 2U);
  EXPECT_DOUBLE_EQ(twice_area(ring), 2 * (100.0 - 4.0));
}

TEST(SingleRing, Hole_WhenItTouchesTheOutline_ThenGoesInAtThatPoint) {
  const Ring ring = single_ring({{{0, 0}, {10, 0}, {10, 10}, {5, 10}, {0, 10}}, {{5, 10}, {4, 6}, {6, 6}}});
  EXPECT_EQ(ring.size(), 5U + 3U);
  EXPECT_DOUBLE_EQ(twice_area(ring), 2 * (100.0 - 4.0));
}

// The second hole's nearest corner is hidden behind the first one.
TEST(SingleRing, Bridge_WhenAnotherHoleStandsInTheWay_ThenLeadsThroughIt) {
  const Ring ring = single_ring({kBox, {{5, 4}, {6, 4}, {6, 6}, {5, 6}}, {{2, 1}, {3, 1}, {3, 9}, {2, 9}}});
  EXPECT_EQ(ring.size(), 4U + 2U * (4U + 2U));
  EXPECT_DOUBLE_EQ(twice_area(ring), 2 * (100.0 - 2.0 - 8.0));
}

TEST(SingleRing, Rings_WhenTheirOrderIsReversed_ThenAreTurned) {
  Ring clockwise(kBox.rbegin(), kBox.rend());
  EXPECT_DOUBLE_EQ(twice_area(single_ring({clockwise, {{4, 4}, {6, 4}, {6, 6}, {4, 6}}})), 2 * 96.0);
}

}  // namespace
}  // namespace stepwright::ltl
