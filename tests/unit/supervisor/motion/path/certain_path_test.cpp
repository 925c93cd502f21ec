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
                                        {.step = 0.5, .most_tries = 20}, {.most_rounds = 12});
  EXPECT_TRUE(answer.path.empty());
  ASSERT_TRUE(answer.refused);
  EXPECT_EQ(answer.refused->contact.other, "sheet");
  EXPECT_GT(answer.rounds, 1u);
}

// Ends that the bodies allow and spheres do not, drawn.
std::vector<Configuration> only_by_bodies(const tests::Scene& scene, const CollisionChecker& fast,
                                          const ExactChecker& exact, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Configuration> found;
  while (found.size() < count) {
    Configuration q = tests::draw_rows(scene, 1, random);
    if (!fast.is_free(q) && !exact.contact(q)) found.push_back(std::move(q));
  }
  return found;
}

TEST(CertainPath, WhenSpheresRefuseAnEndThatTheBodiesAllow_ThenAWayOutIsFoundAndProved) {
  tests::Scene scene = tests::own_scene("right_arm");
  const CollisionChecker fast = scene.checker();
  const ExactChecker exact = tests::exact_of(scene, true);
  const JointSpace space = joint_space(scene.robot, scene.coordinates);
  int found = 0, by_ways = 0;
  for (const Configuration& end : only_by_bodies(scene, fast, exact, 8, 3)) {
    EXPECT_TRUE(plan_path(fast, space, tests::home_of(scene), {end}).path.empty());
    const auto answer = plan_certain_path(fast, exact, space, tests::home_of(scene), {end});
    if (answer.path.empty()) continue;
    ++found;
    by_ways += answer.means == CertainPath::Means::WaysOut;
    EXPECT_EQ(answer.path.front(), tests::home_of(scene));
    EXPECT_EQ(answer.path.back(), end);
    EXPECT_FALSE(first_refused(tests::exact_of(scene), answer.path));
    EXPECT_EQ(plan_certain_path(fast, exact, space, tests::home_of(scene), {end}).path, answer.path);
  }
  EXPECT_GE(found, 7);
  EXPECT_GE(by_ways, 5);
}

TEST(CertainPath, WhenSpheresLeaveNoWayAtAll_ThenTheBodiesAreAsked) {
  // A ball as a box: the sphere around the box does not pass the gate that the box passes.
  const auto robot = read_urdf(
      R"(<robot name="r"><link name="a"/><link name="b"><collision><geometry><box size="0.4 0.1 0.1"/></geometry></collision></link>
    <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="-2" upper="2"/></joint></robot>)",
      "r.urdf");
  const auto bodies = *read_bodies(*robot, MeshLocator("."));
  World world;
  world.obstacles = {box("left", {{}, {0, 0.6, 0}}, {0.1, 1, 1}),
                     box("right", {{}, {0, -0.6, 0}}, {0.1, 1, 1})};
  const std::vector<int> coordinates{0};
  const std::vector<double> rest{0.0};
  const auto fast =
      CollisionChecker::make(*robot, cover(bodies, {.protrusion_m = 1.0}), nullptr, world, coordinates, rest);
  const auto exact = ExactChecker::make(*robot, bodies, nullptr, world, coordinates, rest);
  ASSERT_TRUE(fast && exact);
  const auto answer =
      plan_certain_path(*fast, *exact, joint_space(*robot, coordinates), {-1.0}, {{1.0}}, {.most_tries = 50});
  EXPECT_EQ(answer.path, (JointPath{{-1.0}, {1.0}}));
  EXPECT_EQ(answer.means, CertainPath::Means::ByBodies);
  // Ends that the bodies refuse are named.
  world.obstacles.push_back(box("crate", {{}, {1, 0, 0}}, {0.2, 0.2, 0.2}));
  const auto blocked = CollisionChecker::make(*robot, cover(bodies), nullptr, world, coordinates, rest);
  const auto by_fcl = ExactChecker::make(*robot, bodies, nullptr, world, coordinates, rest);
  const auto refused =
      plan_certain_path(*blocked, *by_fcl, joint_space(*robot, coordinates), {-1.0}, {{1.0}});
  EXPECT_EQ(refused.ending, PathAnswer::Ending::GoalsCollide);
  ASSERT_TRUE(refused.contact);
  EXPECT_EQ(refused.contact->other, "crate");
}

}  // namespace
}  // namespace stepwright::motion
