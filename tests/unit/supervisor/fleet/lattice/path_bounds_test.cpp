// What is known of the costs of paths before they are searched: bounds, and exact costs to a goal.

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "supervisor/fleet/lattice/internal/lattice_search.h"
#include "tests/unit/supervisor/fleet/lattice/cart_test.h"

namespace stepwright::fleet {
namespace {

using geometry::Pose;

class PathBoundsTest : public CartTest {};

TEST_F(PathBoundsTest, CostToGo_WhenHeldAgainstPlainDijkstra_ThenItIsExactAndALowerBoundWhereMoreStands) {
  constexpr std::uint32_t kUnit_mm = 8;
  int exact = 0, detours = 0, none = 0;
  for (int round = 0; round < 10; ++round) {
    const int scale = round % 5 == 4 ? 2 : 1;
    OccupancyGrid grid = random_floor(30 + 4 * round, scale);
    const SweptCells cells(kCart, primitives_, scale);
    const auto planner = PathPlanner::create(grid, kCart, primitives_, table_).value();
    const FreeMotions motions = planner.free_motions(2);
    PlainPose goal = random_pose();
    while (!stands(grid, cells, goal)) goal = random_pose();
    const auto [goal_x, goal_y, goal_heading] = goal;
    const auto to_go = planner.cost_to_go(motions, pose_of(grid, goal));
    ASSERT_TRUE(to_go.has_value());
    EXPECT_EQ(to_go->lower_bound_mm({goal_x, goal_y}, goal_heading), 0U);
    OccupancyGrid fuller = grid;
    for (int k = 0; k < 15; ++k) fuller.set({below(grid.frame().columns), below(grid.frame().rows)}, true);
    const PathPlanner elsewhere = planner.on(fuller);
    for (int question = 0; question < 12; ++question) {
      PlainPose start = random_pose();
      while (!stands(grid, cells, start)) start = random_pose();
      const auto [x, y, heading] = start;
      const std::uint32_t bound = to_go->lower_bound_mm({x, y}, heading);
      const PathAnswer here = planner.plan(pose_of(grid, start), pose_of(grid, goal), {}, &*to_go);
      const PathAnswer plain = planner.plan(pose_of(grid, start), pose_of(grid, goal));
      ASSERT_EQ(here.end, plain.end);
      ASSERT_EQ(bound == CostToGo::kNoWay, plain.end == PathEnd::Unreachable);
      if (!here.path) {
        ++none;
        EXPECT_EQ(here.diagnostics.front().code, plain.diagnostics.front().code);
        continue;
      }
      ++exact;
      EXPECT_EQ(here.path->cost_mm, plain.path->cost_mm);
      EXPECT_EQ(bound, plain.path->cost_mm / kUnit_mm * kUnit_mm);
      EXPECT_LE(here.expanded, plain.expanded);
      expect_sound(grid, *here.path);
      const PathAnswer there = elsewhere.plan(pose_of(grid, start), pose_of(grid, goal), {}, &*to_go);
      const PathAnswer other = elsewhere.plan(pose_of(grid, start), pose_of(grid, goal));
      ASSERT_EQ(there.end, other.end);
      if (!other.path) continue;
      detours += other.path->cost_mm > plain.path->cost_mm ? 1 : 0;
      EXPECT_EQ(there.path->cost_mm, other.path->cost_mm);
      EXPECT_LE(bound, other.path->cost_mm);
      expect_sound(fuller, *there.path);
    }
    EXPECT_FALSE(planner.cost_to_go(motions, {-100.0, 0.0, 0.0}).has_value());
  }
  EXPECT_GT(exact, 30);
  EXPECT_GT(detours, 3);
  EXPECT_GT(none, 3);
}

// Consistent: along each free motion the bound falls by no more than the motion costs.
TEST_F(PathBoundsTest, LowerBound_WhenAlongFreeMotions_ThenItFallsByNoMoreThanTheyCost) {
  const OccupancyGrid grid = random_floor(45);
  const SweptCells cells(kCart, primitives_, 1);
  const DistanceField clearance(grid);
  PlainPose start = random_pose();
  while (!stands(grid, cells, start)) start = random_pose();
  const PlainFloor floor{&grid, primitives_, &cells};
  const PlainCosts costs = plain_costs(floor, start, 30'000);
  ASSERT_GT(costs.size(), 500u);
  const auto [goal_x, goal_y, goal_heading] = costs.rbegin()->first;
  const ObstacleDistances around(clearance, {.goal = {goal_x, goal_y},
                                             .start = {std::get<0>(start), std::get<1>(start)},
                                             .columns = kColumns + 1,
                                             .rows = kRows + 1,
                                             .cells_per_step = 1,
                                             .resolution_m = 0.2,
                                             .inscribed_radius_m = kCart.inscribed_radius_m(),
                                             .detour = detour_of(primitives_)});
  EXPECT_FALSE(around.unreachable());
  EXPECT_EQ(around.lower_bound_mm({goal_x, goal_y}), 0u);
  int edges = 0;
  for (const auto& [pose, cost] : costs) {
    const auto [x, y, heading] = pose;
    for (std::size_t k = 0; k < PrimitiveSet::kPerHeading; ++k) {
      const std::size_t index = static_cast<std::size_t>(heading) * PrimitiveSet::kPerHeading + k;
      if (!plain_free(floor, pose, index)) continue;
      const MotionPrimitive& primitive = primitives_.all()[index];
      EXPECT_LE(around.lower_bound_mm({x, y}),
                primitive.cost_mm + around.lower_bound_mm(GridVector{x, y} + primitive.end));
      ++edges;
    }
  }
  EXPECT_GT(edges, 1000);
}

TEST_F(PathBoundsTest, Distances_WhenCancelled_ThenNothingIsKnownAndNothingIsBoundedWrongly) {
  const OccupancyGrid grid({.resolution_m = 0.2, .origin = {}, .columns = 200, .rows = 200});
  const auto planner = PathPlanner::create(grid, kCart, primitives_, table_).value();
  const std::atomic<bool> cancel = true;
  const Pose from{30.0, 35.0, 2.0};
  EXPECT_EQ(planner.least_ways_m({&from, 1}, {3.0, 3.0, 0.0}, &cancel), std::vector<double>{0.0});
  EXPECT_GE(planner.least_ways_m({&from, 1}, {3.0, 3.0, 0.0})[0], std::hypot(27.0, 32.0) - 1e-9);
}

// With factors of 1 the cost of a path is its length: the least ones by Dijkstra's algorithm.
TEST_F(PathBoundsTest, LeastWays_WhenHeldAgainstTheShortestPaths_ThenNoneIsShorter) {
  const PrimitiveSet by_length(kCart, {.reverse_factor = 1.0, .turn_factor = 1.0, .long_straight_m = 0.6});
  EXPECT_GT(length_detour_of(primitives_), detour_of(primitives_)) << "costs would have done as well";
  std::size_t compared = 0;
  double most = 0.0;
  for (int round = 0; round < 3; ++round) {
    const OccupancyGrid grid = random_floor(30 + 10 * round);
    const SweptCells cells(kCart, primitives_, 1);
    const auto planner = PathPlanner::create(grid, kCart, primitives_, table_).value();
    PlainPose end = random_pose();
    while (!stands(grid, cells, end)) end = random_pose();
    // Each way there is as long as the way back, driven in the other direction.
    const PlainCosts lengths_mm = plain_costs({&grid, by_length, &cells}, end, 20'000);
    std::vector<Pose> from;
    for (const auto& [pose, length_mm] : lengths_mm) from.push_back(pose_of(grid, pose));
    const auto least_m = planner.least_ways_m(from, pose_of(grid, end));
    std::size_t k = 0;
    for (const auto& [pose, length_mm] : lengths_mm) {
      // A length of the lattice counts whole millimetres for each of its primitives, rounded up.
      ASSERT_LE(1000.0 * least_m[k], length_mm + 1e-6) << round;
      if (length_mm > 0) most = std::max(most, 1000.0 * least_m[k] / length_mm);
      ++k;
    }
    compared += lengths_mm.size();
  }
  EXPECT_GT(compared, 2'000U);
  EXPECT_GT(most, 0.95) << "of no use";
}

}  // namespace
}  // namespace stepwright::fleet
