#include "supervisor/motion/kinematics/srs_arm.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/supervisor/motion/kinematics/arms.h"

namespace stepwright::motion {
namespace {

std::vector<Chain> arms_of_the_kind() {
  return {tests::own_arm("left"), tests::own_arm("right"), tests::arm_with_elbow_aside(),
          tests::arm_with_cardan_shoulder()};
}

TEST(SrsArm, WhenAnArmIsOfTheKind_ThenItIsRecognisedAndMovesAlike) {
  Random random(7);
  for (const Chain& chain : arms_of_the_kind()) {
    const auto arm = SrsArm::recognise(chain);
    ASSERT_TRUE(arm);
    for (int k = 0; k < 200; ++k) {
      const auto q = tests::draw(chain, random);
      ASSERT_LT(tests::off(arm->forward(q), chain.forward(q)), 1e-12);
    }
  }
}

TEST(SrsArm, WhenAnArmIsOfAnotherKind_ThenItIsNotTakenForOne) {
  EXPECT_FALSE(SrsArm::recognise(tests::chain_of(tests::two_arms(), "torso", "left_wrist")));  // six joints
  // The wrist's axes miss each other; the second axis of the shoulder is not at right angles to the third.
  EXPECT_FALSE(SrsArm::recognise(
      tests::seven_joints("zyzyzyz", {{}, {}, {}, {0, 0, 0.4}, {0, 0, 0.4}, {}, {0.088, 0, 0}}, 2.0)));
  EXPECT_FALSE(
      SrsArm::recognise(tests::seven_joints("zyyyzyz", {{}, {}, {}, {0, 0, 0.4}, {0, 0, 0.4}, {}, {}}, 2.0)));
  if (const auto panda = tests::data_of_others("arms/panda/panda.urdf")) {
    EXPECT_FALSE(SrsArm::recognise(tests::chain_of(tests::robot_of(*panda), "panda_link0", "panda_link8")));
  }
}

TEST(SrsArm, WhenAPoseCanBeReached_ThenAllSolutionsReachItAndTheFormerValuesAreAmongThem) {
  Random random(8);
  for (const Chain& chain : arms_of_the_kind()) {
    const auto arm = SrsArm::recognise(chain);
    ASSERT_TRUE(arm);
    for (int k = 0; k < 3000; ++k) {
      const auto q = tests::draw(chain, random);
      const Transform tip = chain.forward(q);
      const auto solutions = arm->solve(tip, arm->swivel(q));
      ASSERT_LE(solutions.count, 8u);
      bool again = false;
      for (const SrsSolution& each : solutions) {
        ASSERT_LT(tests::off(chain.forward(each.q), tip), 1e-9);
        ASSERT_TRUE(chain.within_limits(each.q));
        double apart = 0.0;
        for (std::size_t j = 0; j < 7; ++j) apart = std::max(apart, std::abs(wrapped(each.q[j] - q[j])));
        again = again || (apart < 1e-6 && each.branch == arm->branch(q));
      }
      ASSERT_TRUE(again) << "draw " << k;
    }
  }
}

TEST(SrsArm, WhenASwivelIsGiven_ThenEachSolutionHasItAndTheBranchIsAsNamed) {
  Random random(9);
  const auto arm = SrsArm::recognise(tests::own_arm("right"));
  const Chain chain = tests::own_arm("right");
  for (int k = 0; k < 1000; ++k) {
    const Transform tip = chain.forward(tests::draw(chain, random));
    const double swivel = random.between(-3.1, 3.1);
    for (std::size_t b = 0; b < SrsBranch::kCount; ++b) {
      const auto solution = arm->solve(tip, swivel, SrsBranch::number(b), false);
      ASSERT_TRUE(solution);
      ASSERT_LT(tests::off(chain.forward(solution->q), tip), 1e-9);
      if (std::abs(solution->q[3]) < 1e-3) continue;
      ASSERT_NEAR(wrapped(arm->swivel(solution->q) - swivel), 0.0, 1e-9);
      ASSERT_EQ(arm->branch(solution->q), SrsBranch::number(b));
    }
  }
}

TEST(SrsArm, WhenTheArmIsStretchedOrItsAxesFallTogether_ThenSolutionsStillReachThePose) {
  const Chain chain = tests::own_arm("left");
  const auto arm = SrsArm::recognise(chain);
  Random random(10);
  for (int k = 0; k < 500; ++k) {
    auto q = tests::draw(chain, random);
    if (k % 3 == 0) q[3] = 0.0;
    if (k % 3 == 1) q[1] = 0.0;
    if (k % 3 == 2) q[5] = k % 2 == 0 ? 0.0 : 1e-9;
    const Transform tip = chain.forward(q);
    for (std::size_t b = 0; b < SrsBranch::kCount; ++b) {
      const auto solution = arm->solve(tip, arm->swivel(q), SrsBranch::number(b), false);
      ASSERT_TRUE(solution);
      ASSERT_LT(tests::off(chain.forward(solution->q), tip), 1e-9) << k;
    }
  }
}

TEST(SrsArm, WhenThePoseIsTooFar_ThenThereIsNoSolution) {
  const Chain chain = tests::own_arm("left");
  const auto arm = SrsArm::recognise(chain);
  Transform tip = chain.forward(std::array<double, 7>{});
  EXPECT_GT(arm->solve(tip, arm->swivel({})).count, 0u);  // stretched
  const Vector3 outwards = normalised(arm->wrist_m(tip) - arm->shoulder_m());
  tip.position_m += 1e-6 * outwards;
  EXPECT_EQ(arm->solve(tip, 0.0).count, 0u);
  tip.position_m = arm->shoulder_m() + (tip.position_m - arm->wrist_m(tip));
  EXPECT_EQ(arm->solve(tip, 0.0).count, 0u);  // the wrist in the shoulder
  EXPECT_TRUE(arm->arcs(tip).empty());
  EXPECT_NEAR(arm->wrist_distance_m()[1], 0.78, 1e-12);
  // Bent by 120 degrees: 0.40^2 + 0.38^2 - 0.40 * 0.38.
  EXPECT_NEAR(arm->wrist_distance_m()[0], std::sqrt(0.16 + 0.1444 - 0.152), 2e-5);
}

}  // namespace
}  // namespace stepwright::motion
