#include "supervisor/tamp/predicates/workspace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "supervisor/geometry/radical_inverse.h"
#include "supervisor/motion/spatial/random.h"
#include "supervisor/tamp/predicates/samples.h"
#include "supervisor/tamp/predicates/transfer.h"
#include "tests/support/tamp_cells/paper_cells.h"

namespace stepwright::tamp::predicates {
namespace {

using geometry::radical_inverse;

TEST(Samples, WhenTheyAreTaken_ThenTheyAreVanDerCorputsAndLieOnTheSurface) {
  const double expected[] = {0.0, 0.5, 0.25, 0.75, 0.125, 0.625};
  for (std::uint64_t k = 0; k < 6; ++k) EXPECT_EQ(radical_inverse(k, 2), expected[k]);
  EXPECT_NEAR(radical_inverse(5, 3), 2.0 / 3.0 + 1.0 / 9.0, 1e-15);
  const auto problem = test::paper_problem("p2");
  ASSERT_TRUE(problem);
  scene::Surface tray = problem->cell.surfaces[static_cast<std::size_t>(problem->cell.surface("tray"))];
  tray.middle.angle_rad = 0.4;
  for (std::size_t k = 0; k < 200; ++k)
    EXPECT_TRUE(
        lies_within(tray, problem->cell.things[0].form, place_sample(tray, problem->cell.things[0], k)));
}

TEST(ArmWays, WhenPlacesAreDrawn_ThenEveryWayPutsTheToolThereWithinTheLimits) {
  const auto problem = test::paper_problem("p2");
  ASSERT_TRUE(problem);
  motion::Random random(11);
  std::size_t ways = 0, lines = 0;
  for (int k = 0; k < 300; ++k) {
    const scene::ArmModel& arm = problem->cell.arms[static_cast<std::size_t>(k % 2)];
    const ToolPlace place{random.between(0.3, 0.7), random.between(-0.6, 0.6), random.between(0.78, 1.0),
                          random.between(-3.1, 3.1)};
    for (const ArmWay& way : arm_ways(arm, place, 0.15, arm.home)) {
      ++ways;
      const auto bottom = arm.kinematics.solve(
          inverse(arm.base) * scene::tool_pose(place.x_m, place.y_m, place.z_m, place.angle_rad),
          way.swivel_rad, way.branch);
      ASSERT_TRUE(bottom);
      const motion::Transform tip = arm.base * arm.chain.forward(bottom->q);
      EXPECT_LT(distance(tip.position_m, {place.x_m, place.y_m, place.z_m}), 1e-9);
      EXPECT_NEAR(tip.rotation.column(2).z, -1.0, 1e-9);
      EXPECT_NEAR(tip.rotation.column(0).x, std::cos(place.angle_rad), 1e-8);
      EXPECT_TRUE(arm.chain.within_limits(bottom->q, 1e-9) && arm.chain.within_limits(way.top, 1e-9));
      const auto line = line_of(arm, place, 0.15, 0.01, way);
      if (!line) continue;
      ++lines;
      ASSERT_EQ(line->size(), 16u);
      for (std::size_t step = 0; step < line->size(); ++step) {
        const motion::Transform at = arm.base * arm.chain.forward((*line)[step]);
        EXPECT_LT(
            distance(at.position_m, {place.x_m, place.y_m, place.z_m + 0.01 * static_cast<double>(step)}),
            1e-8);
      }
    }
  }
  EXPECT_GT(ways, 150u);
  EXPECT_GT(lines, ways / 2);
}

TEST(Transfer, WhenAnArmGoesFromOnePlaceToAnother_ThenEveryMotionIsFreeAndMostAreStraight) {
  const auto problem = test::paper_problem("p4");
  ASSERT_TRUE(problem);
  Workspace workspace(problem->cell, 1);
  const scene::GeometricState state = initial_state(problem->cell);
  const int right = problem->cell.arm("right");
  const scene::ArmModel& arm = problem->cell.arms[static_cast<std::size_t>(right)];
  const motion::CollisionChecker& checker = workspace.path_checker(state, right);
  const motion::JointSpace space = workspace.joint_space(right);
  motion::Random random(21);
  std::map<Means, int> found;
  std::vector<motion::Configuration> ends{{arm.home.begin(), arm.home.end()}};
  while (ends.size() < 40) {
    const ToolPlace place{random.between(0.3, 0.6), random.between(-0.6, 0.0), 0.9,
                          random.between(-3.1, 3.1)};
    for (const ArmWay& way : arm_ways(arm, place, 0.1, arm.home))
      if (checker.is_free(way.top)) {
        ends.emplace_back(way.top.begin(), way.top.end());
        break;
      }
  }
  for (std::size_t k = 1; k < ends.size(); ++k) {
    motion::PathOptions options;
    options.seed = k;
    const Transfer way = transfer(checker, space, arm, ends[k - 1], ends[k], options);
    if (way.path.empty()) continue;
    ++found[way.means];
    EXPECT_EQ(way.path.front(), ends[k - 1]);
    EXPECT_EQ(way.path.back(), ends[k]);
    for (std::size_t i = 1; i < way.path.size(); ++i) {
      EXPECT_TRUE(motion::inside(space, way.path[i]));
      EXPECT_TRUE(checker.motion_is_free(way.path[i - 1], way.path[i], options.step));
    }
  }
  EXPECT_GT(found[Means::Straight], 10);
  EXPECT_GT(found[Means::ByWayOf], 0);
}

TEST(Workspace, WhenActionsFollow_ThenTheStateSaysWhoHoldsWhat) {
  const auto problem = test::paper_problem("p2");
  ASSERT_TRUE(problem);
  Workspace workspace(problem->cell, 1);
  const scene::GeometricState start = initial_state(problem->cell);
  const int right = problem->cell.arm("right"), tray = problem->cell.surface("tray");
  const scene::ActionSpec pick{scene::ActionKind::Pick, right, 0, -1},
      place{scene::ActionKind::Place, right, 0, tray};
  std::set<std::uint64_t> prints{fingerprint(start)};
  const auto first_of = [&](const scene::GeometricState& state, const scene::ActionSpec& action,
                            const Sample& sample) {
    std::optional<Settled> settled;
    const auto ways = workspace.ways(state, action, sample);
    if (ways)
      for (const ArmWay& way : *ways)
        if (!settled)
          if (auto found = workspace.settle(state, action, sample, way, true)) settled = *std::move(found);
    return settled;
  };
  EXPECT_EQ(workspace.ways(start, place, {}).error().kind, FailureKind::Impossible);
  std::optional<Settled> held, placed;
  const scene::Surface& on = problem->cell.surfaces[static_cast<std::size_t>(tray)];
  for (std::size_t grasp = 0; grasp < 8 && !placed; ++grasp) {
    held = first_of(start, pick, {grasp_sample(grasp), {}});
    for (std::size_t k = 0; k < 20 && held && !placed; ++k)
      placed = first_of(held->after, place, {0.0, place_sample(on, problem->cell.things[0], k)});
  }
  ASSERT_TRUE(held && placed);
  EXPECT_EQ(held->after.things[0].holder, right);
  EXPECT_EQ(held->after.arms[static_cast<std::size_t>(right)].holds, 0);
  EXPECT_TRUE(prints.insert(fingerprint(held->after)).second);
  EXPECT_EQ(workspace.ways(held->after, pick, {}).error().kind, FailureKind::Impossible);
  // On the other can, beyond the tray, on the tray.
  Sample on_other{0.0, problem->cell.things[1].start};
  EXPECT_EQ(workspace.ways(held->after, place, on_other).error().kind, FailureKind::NoRoom);
  EXPECT_EQ(placed->after.things[0].holder, -1);
  EXPECT_EQ(placed->after.arms[static_cast<std::size_t>(right)].near, 0);
  EXPECT_TRUE(prints.insert(fingerprint(placed->after)).second);
  ASSERT_EQ(placed->action.motions.size(), 3u);
  EXPECT_EQ(placed->action.motions[0].path.front(), held->action.motions.back().path.back());
  // A can beside the first one that is in the way of the fingers is named.
  scene::GeometricState crowded = start;
  crowded.things[1].pose = crowded.things[0].pose;
  crowded.things[1].pose.y_m += 0.071;
  const auto blamed = workspace.ways(crowded, pick, {grasp_sample(0), {}});
  ASSERT_FALSE(blamed);
  EXPECT_EQ(blamed.error().kind, FailureKind::HandMeets);
  EXPECT_EQ(blamed.error().things, 2u);
}

}  // namespace
}  // namespace stepwright::tamp::predicates
