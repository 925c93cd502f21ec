#include "supervisor/motion/path/shorten.h"

#include <gtest/gtest.h>

#include "supervisor/motion/path/plan_path.h"
#include "tests/unit/supervisor/motion/scenes.h"

namespace stepwright::motion {
namespace {

TEST(Shorten, WhenAPathHasDetours_ThenItIsShorterAndStillFree) {
  const tests::Scene scene = tests::own_scene("left_arm");
  const CollisionChecker checker = scene.checker();
  const JointSpace space = joint_space(scene.robot, scene.coordinates);
  Random random(1);
  double before = 0.0, after = 0.0;
  for (std::uint64_t k = 0; k < 30; ++k) {
    Configuration from, to;
    do from = tests::draw_rows(scene, 1, random);
    while (!checker.is_free(from));
    do to = tests::draw_rows(scene, 1, random);
    while (!checker.is_free(to));
    const PathAnswer answer =
        plan_path(checker, space, from, {to}, {.seed = k, .most_nodes = 3000, .most_tries = 3000});
    if (answer.path.size() < 4) continue;  // as good as straight
    const JointPath shorter = shorten(checker, answer.path, {.seed = k});
    EXPECT_EQ(shorter.front(), from);
    EXPECT_EQ(shorter.back(), to);
    EXPECT_LE(joint_length(shorter), joint_length(answer.path) + 1e-9);
    for (std::size_t m = 1; m < shorter.size(); ++m)
      ASSERT_TRUE(checker.motion_is_free(shorter[m - 1], shorter[m], 0.02));
    EXPECT_EQ(shorten(checker, answer.path, {.seed = k}), shorter);
    before += joint_length(answer.path);
    after += joint_length(shorter);
  }
  EXPECT_LT(after, 0.9 * before);
}

TEST(Shorten, WhenAPathIsOneMotion_ThenItStays) {
  const tests::Scene scene = tests::own_scene("left_arm");
  const CollisionChecker checker = scene.checker();
  const JointPath path{Configuration(7, 0.0), Configuration(7, 0.1)};
  EXPECT_EQ(shorten(checker, path), path);
}

}  // namespace
}  // namespace stepwright::motion
