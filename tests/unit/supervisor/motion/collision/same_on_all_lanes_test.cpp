#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/supervisor/motion/scenes.h"

namespace stepwright::motion {
namespace {

std::vector<std::uint8_t> by_scalar(const CollisionChecker& checker, const std::vector<double>& rows) {
  std::vector<std::uint8_t> found(rows.size() / checker.columns());
  internal::check_scalar(checker.program(), rows.data(), found.size(), false, found.data());
  return found;
}

// Each instruction set that this machine has, against plain arithmetic.
void expect_same(const tests::Scene& scene, std::uint64_t seed, std::size_t count) {
  const CollisionChecker checker = scene.checker();
  Random random(seed);
  const auto rows = tests::draw_rows(scene, count, random);
  const auto wanted = by_scalar(checker, rows);
  const auto colliding = std::accumulate(wanted.begin(), wanted.end(), std::size_t{0});
  EXPECT_GT(colliding, count / 20);
  EXPECT_LT(colliding, count - count / 100);
  const auto targets = internal::simd_targets();
  EXPECT_FALSE(targets.empty());
  for (const std::int64_t target : targets) {
    internal::choose_simd_target(target);
    EXPECT_EQ(checker.collisions(rows), wanted) << internal::simd_target_name(target);
  }
  internal::choose_simd_target(0);
}

TEST(CollisionLanes, WhenAnInstructionSetIsUsed_ThenResultsAreThoseOfPlainArithmetic) {
  expect_same(tests::own_scene("right_arm"), 1, 3001);  // the last batch is not full
  expect_same(tests::own_scene("both_arms"), 2, 1500);
  tests::Scene hands = tests::own_scene("left_arm");
  hands.coordinates.push_back(hands.robot.coordinate("left_gripper"));  // slides, and a finger that mimics
  expect_same(hands, 3, 1500);
}

TEST(CollisionLanes, WhenNumbersAreAtBorders_ThenResultsStillAgree) {
  // A sphere on a slide that touches a box exactly, misses it by a rounding, or overlaps by one.
  const auto robot = read_urdf(
      R"(<robot name="r"><link name="a"/><link name="b"><collision><geometry><sphere radius="0.25"/></geometry></collision></link>
    <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="-4" upper="4"/></joint></robot>)",
      "r.urdf");
  ASSERT_TRUE(robot);
  const auto spheres = cover(*read_bodies(*robot, MeshLocator(".")));
  World world;
  world.obstacles = {box("wall", {{}, {2, 0, 0}}, {1, 1, 1}), cylinder("post", {{}, {-2, 0, 0}}, 0.5, 1)};
  const std::vector<int> coordinates{0};
  const std::vector<double> rest{0.0};
  const auto checker = CollisionChecker::make(*robot, spheres, nullptr, world, coordinates, rest);
  ASSERT_TRUE(checker) << to_string(checker.error());
  std::vector<double> rows;
  for (int k = -400; k <= 400; ++k)
    for (const double border : {1.25, -1.25, 2.75, -2.75}) rows.push_back(border + 1e-7 * k);
  const auto wanted = by_scalar(*checker, rows);
  for (const std::int64_t target : internal::simd_targets()) {
    internal::choose_simd_target(target);
    EXPECT_EQ(checker->collisions(rows), wanted);
  }
  internal::choose_simd_target(0);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double gap = std::min(std::abs(rows[k] - 2.0), std::abs(rows[k] + 2.0)) - 0.75;
    if (gap > 0.0 && gap <= 2.0 * CollisionChecker::kRounding_m) continue;
    EXPECT_EQ(wanted[k], gap <= 0.0) << rows[k];
  }
}

}  // namespace
}  // namespace stepwright::motion
