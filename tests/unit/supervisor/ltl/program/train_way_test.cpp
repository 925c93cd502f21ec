#include "supervisor/ltl/program/train_way.h"

#include <gtest/gtest.h>

#include <cmath>

#include "supervisor/ltl/planner/plan_train.h"
#include "supervisor/ltl/train/walls.h"
#include "tests/unit/supervisor/ltl/program/small_hall.h"

namespace stepwright::ltl {
namespace {

PlanAnswer planned(const Problem& problem) {
  auto answer = plan_train(problem, {.most_s = 600.0});
  EXPECT_TRUE(answer) << to_string(answer.error());
  return answer ? *std::move(answer) : PlanAnswer{};
}

TEST(TrainWay, WhenAPlanIsSampled_ThenTheWayIsItsWayAndEndsAtRest) {
  const Problem problem = testing::small_hall(2, "visit press then visit rack");
  const PlanAnswer answer = planned(problem);
  const TrainPlan plan = with_run_out(problem, answer.plan);
  const TrainWay way = train_way(problem, plan, {});
  ASSERT_GT(way.samples.size(), 20u);
  EXPECT_NEAR(way.end_m, plan.length_m, 0.05);
  EXPECT_EQ(way.samples.back().speed_m_s, 0.0);
  EXPECT_EQ(way.samples.back().rest_m, way.end_m);
  EXPECT_NEAR(way.samples.front().pose.x_m, problem.start.x_m, 1e-6);
  for (std::size_t k = 1; k < way.samples.size(); ++k) {
    const auto& before = way.samples[k - 1];
    const auto& now = way.samples[k];
    const double step_m = std::hypot(now.pose.x_m - before.pose.x_m, now.pose.y_m - before.pose.y_m);
    EXPECT_NEAR(now.arc_m - before.arc_m, step_m, 0.02 * step_m + 1e-6);
    EXPECT_GE(way.times_s[k], way.times_s[k - 1]);
  }
  EXPECT_GT(way.time_at(way.end_m), way.end_m / TrainDrive{}.top_speed_m_s);
}

TEST(TrainWay, WhenPlacesAreCrossed_ThenTheirLabelsStandAtTheirArcs) {
  const Problem problem = testing::small_hall(1, "visit press then visit rack");
  const TrainPlan plan = with_run_out(problem, planned(problem).plan);
  const TrainWay way = train_way(problem, plan, {});
  ASSERT_FALSE(way.labels.empty());
  EXPECT_EQ(way.labels.front().label, 0u);
  EXPECT_EQ(way.labels.front().arc_m, 0.0);
  double press_m = -1.0, rack_m = -1.0;
  for (const WayLabel& each : way.labels) {
    if (each.label == 1 && press_m < 0.0) press_m = each.arc_m;
    if (each.label == 2) rack_m = each.arc_m;
  }
  EXPECT_GT(press_m, 5.0);
  EXPECT_GT(rack_m, press_m);
  EXPECT_LT(rack_m, way.end_m);
}

TEST(TrainWay, WhenAWallIsBehindTheEnd_ThenTheRunOutEndsBeforeIt) {
  Problem problem = testing::small_hall(0, "visit press");
  const PlanAnswer answer = planned(problem);
  const TrainPlan longer = with_run_out(problem, answer.plan, 100.0);
  const LinkBoxes boxes = link_boxes(problem.train, longer.end);
  EXPECT_GT(longer.length_m, answer.plan.length_m);
  EXPECT_FALSE(Walls(problem.floor, problem.train).meet(boxes, problem.train.links()));
}

// Ahead, to a standstill, and back: two legs.
TEST(TrainWay, WhenATrainTurnsBack_ThenItRestsThere) {
  const Problem problem = testing::small_hall(0, "visit press");
  TrainPlan plan{.start = problem.standing(),
                 .pieces = {{{1.0, 0.0}, 1.0}, {{-1.0, 0.0}, 2.0}, {{1.0, 0.0}, 1.0}}};
  const TrainWay way = train_way(problem, plan, {});
  ASSERT_FALSE(way.samples.empty());
  EXPECT_NEAR(way.end_m, 2.0, 0.02);
  std::size_t twice = 0;
  for (std::size_t k = 1; k < way.samples.size(); ++k)
    if (way.samples[k].arc_m == way.samples[k - 1].arc_m) ++twice;
  EXPECT_EQ(twice, 1u);
  EXPECT_EQ(way.samples.front().way, 1.0);
  EXPECT_EQ(way.samples.back().way, -1.0);
  EXPECT_NEAR(way.samples.back().pose.x_m, problem.start.x_m, 0.01);
}

}  // namespace
}  // namespace stepwright::ltl
