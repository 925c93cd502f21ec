#include "tests/support/fleet/circle_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/support/fleet/split_mix.h"

namespace stepwright::support {
namespace {

TEST(CircleProblem, Draw_WhenAnyOfTheNineHundred_ThenPointsDifferAsThePaperAsks) {
  std::set<int> poses;
  for (int vehicles = 2; vehicles <= kCirclePoints; ++vehicles) {
    for (int run = 0; run < kCircleRuns; ++run) {
      const auto tasks = circle_problem(vehicles, run);
      ASSERT_EQ(tasks.size(), static_cast<std::size_t>(vehicles));
      std::set<int> starts;
      std::set<int> goals;
      for (const CircleTask& task : tasks) {
        EXPECT_NE(task.start.point, task.goal.point);
        starts.insert(task.start.point);
        goals.insert(task.goal.point);
        poses.insert(task.start.index());
      }
      EXPECT_EQ(starts.size(), tasks.size());
      EXPECT_EQ(goals.size(), tasks.size());
    }
  }
  EXPECT_EQ(poses.size(), 80u);
}

// Frozen: who compares results with ours must have drawn the same problems.
TEST(CircleProblem, Draw_WhenTheSeedIsTheSame_ThenSoIsTheProblemForEver) {
  EXPECT_EQ(SplitMix64(0).next(), 0xe220a8397b1dcdafu);
  const auto tasks = circle_problem(3, 7);
  EXPECT_EQ(tasks[0].start, (CirclePose{6, 3}));
  EXPECT_EQ(tasks[0].goal, (CirclePose{0, 3}));
  EXPECT_EQ(tasks[2].goal, (CirclePose{5, 1}));
}

TEST(CircleProblem, Pose_WhenOnTheCircle_ThenTwentyMetresFromTheMiddle) {
  for (int point = 0; point < kCirclePoints; ++point) {
    const auto pose = CirclePose{point, 3}.pose();
    EXPECT_NEAR(std::hypot(pose.x_m - 25.0, pose.y_m - 25.0), 20.0, 1e-12);
    EXPECT_NEAR(pose.heading_rad, 0.75 * std::acos(-1.0), 1e-12);
  }
}

}  // namespace
}  // namespace stepwright::support
