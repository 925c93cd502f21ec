#include "supervisor/fleet/lattice/path_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <numbers>
#include <string>
#include <vector>

#include "supervisor/fleet/lattice/internal/lattice_search.h"
#include "tests/support/fleet/floor_maps.h"
#include "tests/unit/supervisor/fleet/lattice/cart_test.h"

namespace stepwright::fleet {
namespace {

using geometry::Pose;
using ::testing::HasSubstr;

class PathPlannerTest : public CartTest {};

TEST_F(PathPlannerTest, Plan_WhenHeldAgainstPlainDijkstra_ThenCostsAreTheLeastAndVerdictsTheSame) {
  int found = 0;
  int unreachable = 0;
  for (int round = 0; round < 24; ++round) {
    const int scale = round % 6 == 5 ? 2 : 1;
    const OccupancyGrid grid = random_floor(30 + 2 * round, scale);
    const SweptCells cells(kCart, primitives_, scale);
    const auto planner = PathPlanner::create(grid, kCart, primitives_, table_).value();
    PlainPose start = random_pose();
    while (!stands(grid, cells, start)) start = random_pose();
    PlainPose goal = random_pose();
    while (!stands(grid, cells, goal)) goal = random_pose();
    const PlainCosts costs = plain_costs({&grid, primitives_, &cells}, start, 1'000'000, goal);
    for (const Heuristic heuristic : {Heuristic::Euclid, Heuristic::Table, Heuristic::Combined}) {
      const PathAnswer answer =
          planner.plan(pose_of(grid, start), pose_of(grid, goal), {.heuristic = heuristic});
      ASSERT_EQ(answer.end == PathEnd::Found, costs.contains(goal)) << round;
      if (!costs.contains(goal)) {
        ++unreachable;
        EXPECT_EQ(answer.end, PathEnd::Unreachable);
        EXPECT_FALSE(answer.diagnostics.empty());
        continue;
      }
      ++found;
      EXPECT_EQ(answer.path->cost_mm, costs.at(goal)) << round;
      EXPECT_EQ(answer.epsilon, 1.0);
      expect_sound(grid, *answer.path);
      EXPECT_LT(distance(answer.path->poses.back().pose.position(), pose_of(grid, goal).position()), 1e-9);
    }
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(unreachable, 5);
}

// Exact on its own floor, never too much on one with more obstacles, and A* with it finds the least cost
// there.
TEST_F(PathPlannerTest, VisitReachable_WhenHeldAgainstPlainDijkstra_ThenAllThatIsReachedComesCheapestFirst) {
  for (int floor = 0; floor < 6; ++floor) {
    const OccupancyGrid grid = random_floor(40);
    const SweptCells cells(kCart, primitives_, 1);
    const auto planner = PathPlanner::create(grid, kCart, primitives_, table_);
    ASSERT_TRUE(planner);
    PlainPose start = random_pose();
    while (!stands(grid, cells, start)) start = random_pose();
    const PlainCosts expected = plain_costs({&grid, primitives_, &cells}, start, 5'000);
    std::uint32_t last = 0;
    std::size_t met = 0;
    planner->visit_reachable(pose_of(grid, start), 1'000'000, [&](const Pose& at, std::uint32_t cost_mm) {
      EXPECT_GE(cost_mm, last);
      last = cost_mm;
      if (cost_mm > 5'000) return false;
      const PlainPose pose{static_cast<std::int32_t>(std::lround((at.x_m - grid.frame().origin.x_m) / 0.2)),
                           static_cast<std::int32_t>(std::lround((at.y_m - grid.frame().origin.y_m) / 0.2)),
                           nearest_heading(at.heading_rad)};
      const auto known = expected.find(pose);
      EXPECT_TRUE(known != expected.end() && known->second == cost_mm);
      ++met;
      return true;
    });
    const auto within =
        std::ranges::count_if(expected, [](const auto& entry) { return entry.second <= 5'000; });
    EXPECT_EQ(met, static_cast<std::size_t>(within));
    EXPECT_LE(
        planner->visit_reachable(pose_of(grid, start), 7, [](const Pose&, std::uint32_t) { return true; }),
        7U);
  }
}

TEST_F(PathPlannerTest, On_WhenTheMapIsAnother_ThenItPlansAsIfItHadBeenMadeForIt) {
  const OccupancyGrid first = random_floor(10);
  const OccupancyGrid second = random_floor(60);
  const auto made_for_first = PathPlanner::create(first, kCart, primitives_, table_).value();
  const auto made_for_second = PathPlanner::create(second, kCart, primitives_, table_).value();
  const PathPlanner moved = made_for_first.on(second);
  int found = 0, none = 0;
  for (int round = 0; round < 30; ++round) {
    const Pose start = pose_of(second, random_pose());
    const Pose goal = pose_of(second, random_pose());
    const PathAnswer expected = made_for_second.plan(start, goal);
    const PathAnswer answer = moved.plan(start, goal);
    ASSERT_EQ(answer.end, expected.end);
    ASSERT_EQ(answer.path.has_value(), expected.path.has_value());
    if (answer.path) {
      EXPECT_EQ(answer.path->cost_mm, expected.path->cost_mm);
    }
    (answer.path ? found : none) += 1;
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(none, 0);
}

TEST_F(PathPlannerTest, Plan_WhenAnytime_ThenEachBoundHoldsAndTheLastPathIsTheBest) {
  int rounds = 0;
  for (int round = 0; round < 20; ++round) {
    const OccupancyGrid grid = random_floor(25);
    const SweptCells cells(kCart, primitives_, 1);
    const auto planner = PathPlanner::create(grid, kCart, primitives_, table_).value();
    PlainPose from = random_pose();
    while (!stands(grid, cells, from)) from = random_pose();
    PlainPose to = random_pose();
    while (!stands(grid, cells, to)) to = random_pose();
    const Pose start = pose_of(grid, from);
    const Pose goal = pose_of(grid, to);
    const PathAnswer best = planner.plan(start, goal);
    const PathAnswer anytime = planner.plan(start, goal, {.first_weight = 4.0, .weight_step = 0.7});
    ASSERT_EQ(anytime.end, best.end);
    if (best.end != PathEnd::Found) continue;
    const PathAnswer enough = planner.plan(start, goal, {.first_weight = 4.0, .last_weight = 1.5});
    EXPECT_LE(enough.epsilon, 1.5);
    EXPECT_LE(enough.path->cost_mm, 1.5 * best.path->cost_mm);
    double before = std::numeric_limits<double>::infinity();
    for (const Improvement& improvement : anytime.improvements) {
      EXPECT_GE(improvement.epsilon, 1.0);
      EXPECT_LE(improvement.cost_mm, improvement.epsilon * best.path->cost_mm * (1.0 + 1e-12));
      EXPECT_GE(improvement.cost_mm, best.path->cost_mm);
      EXPECT_LE(improvement.cost_mm, before);
      before = improvement.cost_mm;
      ++rounds;
    }
    EXPECT_EQ(anytime.epsilon, 1.0);
    EXPECT_EQ(anytime.path->cost_mm, best.path->cost_mm);
    expect_sound(grid, *anytime.path);
  }
  EXPECT_GT(rounds, 25);
}

TEST_F(PathPlannerTest, Plan_WhenAPoseIsNoPlaceToStand_ThenItSaysWhichAndWhy) {
  OccupancyGrid grid = random_floor(0);
  grid.set({10, 10}, true);
  const auto planner = PathPlanner::create(grid, kCart, primitives_, table_).value();
  const Pose fine{2.0, 4.0, 0.0};
  const auto refusal = [&](const Pose& start, const Pose& goal) {
    const PathAnswer answer = planner.plan(start, goal);
    EXPECT_EQ(answer.end, PathEnd::Refused);
    return to_string(answer.diagnostics);
  };
  EXPECT_THAT(refusal({-50.0, 4.0, 0.0}, fine),
              HasSubstr("F0302: the start (-50.00 m, 4.00 m, 0.00 rad) is off the map"));
  EXPECT_THAT(refusal(fine, {std::nan(""), 4.0, 0.0}), HasSubstr("F0302: the goal"));
  EXPECT_THAT(refusal(fine, {-1.0, 3.0, 0.0}), HasSubstr("F0303: the goal (-1.00 m, 3.00 m, 0.00 rad) is in "
                                                         "collision with the obstacle at (-1.00 m, 3.00 m)"));
  EXPECT_THAT(
      refusal({-2.8, 4.0, 0.0}, fine),
      HasSubstr("F0303: at the start (-2.80 m, 4.00 m, 0.00 rad) the vehicle stands over the border"));
}

TEST_F(PathPlannerTest, Plan_WhenTheGoalCannotBeReached_ThenItSaysWhy) {
  OccupancyGrid grid = random_floor(0);
  for (int row = 0; row < kRows; ++row) grid.set({20, row}, true);
  const Pose left{-1.0, 4.0, 0.0};
  const Pose right{3.0, 4.0, 0.0};
  const auto walled = PathPlanner::create(grid, kCart, primitives_, table_)->plan(left, right);
  EXPECT_EQ(walled.end, PathEnd::Unreachable);
  EXPECT_EQ(walled.diagnostics.front().code, "F0304");
  // A gap that a disc passes, but not a vehicle that is longer than it is wide and cannot turn there.
  const VehicleModel bus{
      .wheelbase_m = 1.0, .min_turning_radius_m = 4.0, .front_m = 2.0, .rear_m = 0.4, .width_m = 0.6};
  const PrimitiveSet stiff(bus, {});
  const HeuristicTable none = HeuristicTable::build(stiff, {.range_m = 0.2, .margin_m = 1.0});
  OccupancyGrid corner = random_floor(0);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const bool lane = (row >= 4 && row < 9) || (column >= 30 && column < 35);
      corner.set({column, row}, !lane);
    }
  }
  const auto stuck = PathPlanner::create(corner, bus, stiff, none)
                         ->plan({-1.0, 2.3, 0.0}, {3.5, 4.0, 0.5 * std::numbers::pi});
  EXPECT_EQ(stuck.end, PathEnd::Unreachable);
  EXPECT_THAT(to_string(stuck.diagnostics), HasSubstr("F0305: none of the "));
}

TEST_F(PathPlannerTest, Create_WhenTheMapsCellsDoNotFitTheLattice_ThenRefused) {
  const OccupancyGrid grid({.resolution_m = 0.15, .origin = {}, .columns = 10, .rows = 10});
  const auto planner = PathPlanner::create(grid, kCart, primitives_, table_);
  ASSERT_FALSE(planner.has_value());
  EXPECT_EQ(planner.error().front().code, "F0301");
}

TEST_F(PathPlannerTest, Plan_WhenStartIsGoal_ThenThePathIsOnePose) {
  const OccupancyGrid grid = random_floor(0);
  const PathAnswer answer =
      PathPlanner::create(grid, kCart, primitives_, table_)->plan({1, 4, 0}, {1.04, 3.97, 0.1});
  ASSERT_EQ(answer.end, PathEnd::Found);
  EXPECT_EQ(answer.path->poses.size(), 1u);
  EXPECT_EQ(answer.path->cost_mm, 0u);
  EXPECT_TRUE(answer.path->marks.empty());
}

// Time that has already passed, and a stop that was already asked for: no test of how fast a machine is.
TEST_F(PathPlannerTest, Plan_WhenTimeEndsOrSomebodyStopsIt_ThenItSaysSo) {
  const OccupancyGrid grid({.resolution_m = 0.2, .origin = {}, .columns = 200, .rows = 200});
  const auto planner = PathPlanner::create(grid, kCart, primitives_, table_).value();
  const Pose start{3.0, 3.0, 0.0};
  const Pose goal{30.0, 35.0, 2.0};
  const auto late = planner.plan(
      start, goal, {.heuristic = Heuristic::Euclid, .deadline = std::chrono::steady_clock::now()});
  EXPECT_EQ(late.end, PathEnd::Deadline);
  EXPECT_FALSE(late.path.has_value());
  const std::atomic<bool> cancel = true;
  const auto cancelled = planner.plan(start, goal, {.heuristic = Heuristic::Euclid, .cancel = &cancel});
  EXPECT_EQ(cancelled.end, PathEnd::Cancelled);
  EXPECT_LE(cancelled.expanded, 256u);
}

// In the middle of a search that goes on for long without it: counted, whatever the machine.
TEST_F(PathPlannerTest, Search_WhenCancelledInTheMiddle_ThenItEndsWithinSomeHundredExpansions) {
  const OccupancyGrid grid({.resolution_m = 0.2, .origin = {}, .columns = 200, .rows = 200});
  const SweptCells cells(kCart, primitives_, 1);
  const DistanceField clearance(grid);
  const internal::LatticePose start{{15, 15}, 0}, goal{{150, 175}, 5};
  const ObstacleQuestion question{.goal = goal.vertex,
                                  .start = start.vertex,
                                  .columns = 201,
                                  .rows = 201,
                                  .inscribed_radius_m = kCart.inscribed_radius_m(),
                                  .detour = detour_of(primitives_)};
  const ObstacleDistances around(clearance, question);
  const internal::SearchFloor floor{grid, clearance, primitives_, cells, table_, &around, nullptr, 201, 201};
  std::atomic<bool> cancel = false;
  PathOptions options{.heuristic = Heuristic::Euclid, .most_expanded = 10'000, .cancel = &cancel};
  internal::LatticeSearch search(floor, start, goal, options);
  EXPECT_EQ(search.run_round(1.0), internal::RoundEnd::Deadline);
  const std::uint64_t before = search.expanded();
  EXPECT_GE(before, 10'000U);
  options.most_expanded = 0;
  cancel = true;
  EXPECT_EQ(search.run_round(1.0), internal::RoundEnd::Cancelled);
  EXPECT_LE(search.expanded(), before + 256);
  cancel = false;
  EXPECT_EQ(search.run_round(1.0), internal::RoundEnd::Solved);
  EXPECT_GT(search.expanded(), before + 5'000) << "it was near its end before it was cancelled";
}

TEST(LatticeMine, Plan_WhenInAMine_ThenThePathIsFreeForTheExactOutlineAndTheBoundIsTold) {
  const VehicleModel forklift;
  const PrimitiveSet primitives(forklift, {});
  const HeuristicTable table = HeuristicTable::build(primitives, {.range_m = 3.0, .margin_m = 3.0});
  const support::DrawnFloor mine = support::draw_mine(1);
  const auto planner = PathPlanner::create(mine.grid, forklift, primitives, table).value();
  for (const Pose& station : mine.stations)
    EXPECT_FALSE(support::outline_hits(mine.grid, forklift.footprint(), station));
  const PathAnswer answer =
      planner.plan(mine.stations[0], mine.stations[3], {.first_weight = 3.0, .last_weight = 1.6});
  ASSERT_EQ(answer.end, PathEnd::Found) << to_string(answer.diagnostics);
  EXPECT_EQ(support::first_hit(mine.grid, forklift.footprint(), answer.path->poses), std::nullopt);
  EXPECT_LE(answer.epsilon, 1.6);
  EXPECT_GT(answer.path->length_m, 25.0);
}

}  // namespace
}  // namespace stepwright::fleet
