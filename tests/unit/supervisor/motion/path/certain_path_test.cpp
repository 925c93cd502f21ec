#include "supervisor/motion/path/certain_path.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/exact_scenes.h"

namespace stepwright::motion {
namespace {

TEST(CertainPath, WhenAPathIsFound_ThenEveryMotionIsFreeByTheBodiesThemselves) {
  const tests::Scene scene = tests::own_scene("left_arm");
  const CollisionChecker fast = scene.checker();
  const ExactChecker exact = tests::exact_of(scene, true);
  const JointSpace space = joint_space(scene.robot, scene.coordinates);
  Random random(1);
  int found = 0;
  for (std::uint64_t k = 0; k < 10; ++k) {
    Configuration to;
    do to = tests::draw_rows(scene, 1, random);
    while (!fast.is_free(to));
    const auto answer = plan_certain_path(fast, exact, space, tests::home_of(scene), {to},
                                          {.seed = k, .most_nodes = 3000, .most_tries = 3000});
    if (answer.path.empty()) continue;
    ++found;
    EXPECT_EQ(answer.path.back(), to);
    EXPECT_FALSE(first_refused(tests::exact_of(scene), answer.path));
  }
  EXPECT_GE(found, 7);
}

TEST(CertainPath, WhenPlacesThatAreTriedMissAThing_ThenLaterRoundsTryMore) {
  // A ball that slides past a sheet thinner than the step: the first rounds do not see it.
  const auto robot = read_urdf(
      R"(<robot name="r"><link name="a"/><link name="b"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
    <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="-4" upper="4"/></joint></robot>)",
      "r.urdf");
  const auto bodies = *read_bodies(*robot, MeshLocator("."));
  World world;
  world.obstacles = {box("sheet", {{}, {0.26, 0, 0}}, {1e-3, 1, 1})};
  const std::vector<int> coordinates{0};
  const std::vector<double> rest{0.0};
  const auto fast = CollisionChecker::make(*robot, cover(bodies), nullptr, world, coordinates, rest);
  const auto exact = ExactChecker::make(*robot, bodies, nullptr, world, coordinates, rest);
  ASSERT_TRUE(fast && exact);
  const auto answer = plan_certain_path(*fast, *exact, joint_space(*robot, coordinates), {-1.0}, {{1.0}},
                                        {.step = 0.5, .most_tries = 20}, 12);
  EXPECT_TRUE(answer.path.empty());
  ASSERT_TRUE(answer.refused);
  EXPECT_EQ(answer.refused->contact.other, "sheet");
  EXPECT_GT(answer.rounds, 1u);
}

}  // namespace
}  // namespace stepwright::motion
