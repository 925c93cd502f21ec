#include "plant_models/assemblies/overlap_monitor.h"

#include <gtest/gtest.h>

#include <numbers>

namespace stepwright::assemblies {
namespace {

// Outlines reach 1.6 m ahead, 2.4 m back, 0.7 m to each side.
FleetParameters two_vehicles() {
  FleetParameters parameters;
  parameters.starts = {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}};
  parameters.walls = {{{{1.0, 20.0}}, {{20.0, 0.0}, 0.0}}};
  parameters.blockages = {{{{2.0, 2.0}}, {{0.0, 10.0}, 0.0}}};
  return parameters;
}

OverlapMonitor looked(const ForkliftPose& first, const ForkliftPose& second, bool blocked = false) {
  OverlapMonitor monitor(two_vehicles());
  monitor.set_present(0, blocked);
  monitor.put(0, first);
  monitor.put(1, second);
  monitor.look();
  return monitor;
}

TEST(OverlapMonitor, WhenVehiclesAreApart_ThenTheGapIsBetweenTheirOutlines) {
  const OverlapMonitor behind = looked({0.0, 0.0, 0.0}, {10.0, 0.0, 0.0});
  EXPECT_EQ(behind.overlaps(), 0u);
  EXPECT_NEAR(behind.smallest_gap_m(), 10.0 - 1.6 - 2.4, 1e-12);
  const OverlapMonitor beside = looked({0.0, 0.0, 0.0}, {0.5, -3.0, std::numbers::pi});
  EXPECT_NEAR(beside.smallest_gap_m(), 3.0 - 1.4, 1e-12);
}

TEST(OverlapMonitor, WhenOutlinesCrossWithoutACornerInside_ThenThatIsAnOverlap) {
  const OverlapMonitor crossed = looked({0.0, 0.0, 0.0}, {-0.4, 0.4, 0.5 * std::numbers::pi});
  EXPECT_EQ(crossed.overlaps(), 1u);
  EXPECT_EQ(crossed.smallest_gap_m(), 0.0);
}

TEST(OverlapMonitor, WhenOutlinesNearlyTouchAtAnAngle_ThenOnlyTheExactOnesDecide) {
  // The corner of the second points at the side of the first; bounding boxes would overlap.
  const double turned = 0.25 * std::numbers::pi;
  const OverlapMonitor apart = looked({0.0, 0.0, 0.0}, {2.3, 3.3, turned});
  const OverlapMonitor together = looked({0.0, 0.0, 0.0}, {2.0, 2.4, turned});
  EXPECT_EQ(apart.overlaps(), 0u);
  EXPECT_GT(apart.smallest_gap_m(), 0.0);
  EXPECT_EQ(together.overlaps(), 1u);
}

TEST(OverlapMonitor, WhenAVehicleIsInAWallOrABlockedPlace_ThenThatIsCounted) {
  EXPECT_EQ(looked({0.0, 0.0, 0.0}, {17.0, 0.0, 0.0}).obstacle_overlaps(), 0u);
  EXPECT_EQ(looked({0.0, 0.0, 0.0}, {18.0, 0.0, 0.0}).obstacle_overlaps(), 1u);
  EXPECT_EQ(looked({0.0, 10.0, 0.0}, {10.0, 0.0, 0.0}).obstacle_overlaps(), 0u);
  EXPECT_EQ(looked({0.0, 10.0, 0.0}, {10.0, 0.0, 0.0}, true).obstacle_overlaps(), 1u);
}

}  // namespace
}  // namespace stepwright::assemblies
