#include <gtest/gtest.h>

#include "tests/bench/lattice/circle_envelopes.h"
#include "tests/bench/lattice/plain_search.h"
#include "tests/support/fleet/floor_maps.h"

namespace stepwright::bench {
namespace {

using namespace fleet;

class LatticeBench : public ::testing::Test {
 protected:
  VehicleModel vehicle_;
  PrimitiveSet primitives_{vehicle_, {}};
  HeuristicTable table_ = HeuristicTable::build(primitives_, {.range_m = 26.0, .margin_m = 4.0});
};

// The baseline searches the same lattice: where nothing is near, both find the same least cost.
TEST_F(LatticeBench, PlainSearch_WhenTheFloorIsFree_ThenItFindsTheSameCost) {
  const OccupancyGrid floor({.resolution_m = 0.2, .origin = {}, .columns = 120, .rows = 120});
  const auto planner = PathPlanner::create(floor, vehicle_, primitives_, table_).value();
  const geometry::Pose start{8.0, 10.0, 0.0};
  const geometry::Pose goal{14.0, 12.0, 1.0};
  const PathAnswer answer = planner.plan(start, goal);
  const PlainResult plain = plain_search(floor, vehicle_, primitives_, start, goal);
  ASSERT_TRUE(answer.path.has_value() && plain.found);
  EXPECT_EQ(plain.cost_mm, answer.path->cost_mm);
}

// Every way is grown once; the times are those that are asked for.
TEST_F(LatticeBench, CircleEnvelopes_WhenAskedTwice_ThenTheyAreTheSameAndTimesFollowTheSpeed) {
  CircleEnvelopes circle(vehicle_, primitives_, table_, {});
  const support::CircleTask task = support::circle_problem(2, 4)[0];
  GrownEnvelope grown = circle.of(task);
  EXPECT_EQ(&circle.of(task), &circle.of(task));
  EXPECT_EQ(circle.planned(), 1u);
  const SpeedLimits fast{.min_mps = 0.05, .max_mps = 15.0};
  set_times(grown, fast);
  EXPECT_EQ(grown.envelope.polygons[0].stay, time_bounds(grown.visits[0].exit_m, fast));
}

}  // namespace
}  // namespace stepwright::bench
