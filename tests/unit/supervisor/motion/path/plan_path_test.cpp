#include "supervisor/motion/path/plan_path.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/scenes.h"

namespace stepwright::motion {
namespace {

using Ending = PathAnswer::Ending;

Configuration free_place(const tests::Scene& scene, const CollisionChecker& checker, Random& random) {
  for (;;)
    if (auto q = tests::draw_rows(scene, 1, random); checker.is_free(q)) return q;
}

TEST(PlanPath, WhenBothEndsAreFree_ThenAPathIsFoundWhoseMotionsAreFree) {
  const tests::Scene scene = tests::own_scene("right_arm");
  const CollisionChecker checker = scene.checker();
  const JointSpace space = joint_space(scene.robot, scene.coordinates);
  Random random(1);
  int found = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    const auto from = free_place(scene, checker, random), to = free_place(scene, checker, random);
    const PathAnswer answer =
        plan_path(checker, space, from, {to}, {.seed = k, .most_nodes = 5000, .most_tries = 5000});
    if (answer.ending != Ending::Found) continue;
    ++found;
    EXPECT_EQ(answer.path.front(), from);
    EXPECT_EQ(answer.path.back(), to);
    for (std::size_t m = 1; m < answer.path.size(); ++m)
      ASSERT_TRUE(checker.motion_is_free(answer.path[m - 1], answer.path[m], 0.02));
    const PathAnswer again =
        plan_path(checker, space, from, {to}, {.seed = k, .most_nodes = 5000, .most_tries = 5000});
    EXPECT_EQ(again.path, answer.path);
  }
  EXPECT_GE(found, 15);
}

TEST(PlanPath, WhenAnEndCollidesOrIsOutside_ThenThatIsSaid) {
  const tests::Scene scene = tests::own_scene("right_arm");
  const CollisionChecker checker = scene.checker();
  const JointSpace space = joint_space(scene.robot, scene.coordinates);
  Random random(2);
  const auto free = free_place(scene, checker, random);
  Configuration colliding;
  do colliding = tests::draw_rows(scene, 1, random);
  while (checker.is_free(colliding));
  Configuration outside = free;
  outside[0] = 3.5;
  EXPECT_EQ(plan_path(checker, space, colliding, {free}).ending, Ending::StartCollides);
  EXPECT_EQ(plan_path(checker, space, outside, {free}).ending, Ending::StartCollides);
  EXPECT_EQ(plan_path(checker, space, free, {colliding, outside}).ending, Ending::GoalsCollide);
  EXPECT_EQ(plan_path(checker, space, free, {}).ending, Ending::GoalsCollide);
  const PathAnswer answer = plan_path(checker, space, free, {colliding, free});
  EXPECT_EQ(answer.ending, Ending::Found);
  EXPECT_EQ(answer.path.back(), free);
}

TEST(PlanPath, WhenNoPathIsThere_ThenItEndsAfterItsTries) {
  // A slide with a wall between its ends.
  const auto robot = read_urdf(
      R"(<robot name="r"><link name="a"/><link name="b"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="-4" upper="4"/></joint></robot>)",
      "r.urdf");
  World world;
  world.obstacles = {box("wall", {}, {0.1, 1, 1})};
  const std::vector<int> coordinates{0};
  const std::vector<double> rest{0.0};
  const auto checker = CollisionChecker::make(*robot, cover(*read_bodies(*robot, MeshLocator("."))), nullptr,
                                              world, coordinates, rest);
  ASSERT_TRUE(checker);
  const PathAnswer answer = plan_path(*checker, joint_space(*robot, coordinates), {-2.0}, {{2.0}},
                                      {.most_nodes = 100'000, .most_tries = 200});
  EXPECT_EQ(answer.ending, Ending::Exhausted);
  EXPECT_TRUE(answer.path.empty());
}

}  // namespace
}  // namespace stepwright::motion
