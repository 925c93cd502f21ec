#include "supervisor/motion/kinematics/newton.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/kinematics/arms.h"

namespace stepwright::motion {
namespace {

void expect_poses_found(const Chain& chain, std::uint64_t seed, int poses, int at_least) {
  Random random(seed);
  int solved = 0;
  for (int k = 0; k < poses; ++k) {
    std::vector<double> q;
    for (const ChainJoint& joint : chain.joints())
      q.push_back(random.between(std::max(joint.lower, -3.0), std::min(joint.upper, 3.0)));
    const Transform tip = chain.forward(q);
    const auto found = solve_by_newton(chain, tip, {.seed = seed + static_cast<std::uint64_t>(k)});
    for (const auto& each : found) {
      ASSERT_LT(tests::off(chain.forward(each), tip), 1e-9);
      ASSERT_TRUE(chain.within_limits(each));
    }
    solved += !found.empty();
  }
  EXPECT_GE(solved, at_least);
}

TEST(Newton, WhenAPoseCanBeReached_ThenItIsFoundFromManyStarts) {
  expect_poses_found(tests::own_arm("left"), 21, 100, 99);
  if (const auto panda = tests::data_of_others("arms/panda/panda.urdf"))
    expect_poses_found(tests::chain_of(tests::robot_of(*panda), "panda_link0", "panda_link8"), 22, 100, 99);
  if (const auto ur5 = tests::data_of_others("arms/ur5/ur5.urdf"))
    expect_poses_found(tests::chain_of(tests::robot_of(*ur5), "base_link", "ee_link"), 23, 100, 99);
}

TEST(Newton, WhenTheSeedIsTheSame_ThenSoAreTheSolutions) {
  const Chain chain = tests::own_arm("left");
  Random random(24);
  const Transform tip = chain.forward(tests::draw(chain, random));
  const auto first = solve_by_newton(chain, tip, {.seed = 5, .most = 4});
  EXPECT_EQ(first, solve_by_newton(chain, tip, {.seed = 5, .most = 4}));
  EXPECT_EQ(first.size(), 4u);
  EXPECT_NE(first, solve_by_newton(chain, tip, {.seed = 6, .most = 4}));
}

TEST(Newton, WhenAStartIsGiven_ThenTheSolutionNearItIsFoundFirst) {
  const Chain chain = tests::own_arm("right");
  const std::vector<double> q{0.3, 0.8, -0.4, 1.2, 0.5, -0.7, 0.2};
  std::vector<double> near = q;
  for (double& each : near) each += 0.01;
  const auto found = solve_by_newton(chain, chain.forward(q), {.starts = 0, .near = near});
  ASSERT_EQ(found.size(), 1u);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(found[0][k], q[k], 0.05);
}

TEST(Newton, WhenThePoseIsOutOfReach_ThenNothingIsFound) {
  const Chain chain = tests::own_arm("right");
  EXPECT_TRUE(solve_by_newton(chain, {{}, {5, 0, 0}}, {.starts = 5}).empty());
}

}  // namespace
}  // namespace stepwright::motion
