#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/supervisor/motion/kinematics/arms.h"

namespace stepwright::motion {
namespace {

constexpr double kPi = std::numbers::pi;

bool covers(const SwivelArc& arc, double swivel, double slack) {
  for (const double turn : {0.0, 2.0 * kPi})
    if (swivel + turn >= arc.from_rad - slack && swivel + turn <= arc.to_rad + slack) return true;
  return false;
}

// Arcs against solutions one by one: inside of an arc there is one, outside there is none; only at ends,
// where rounding decides, either may be.
void expect_arcs_as_sampled(const Chain& chain, std::uint64_t seed, int poses) {
  const auto arm = SrsArm::recognise(chain);
  ASSERT_TRUE(arm);
  Random random(seed);
  for (int k = 0; k < poses; ++k) {
    const auto q = tests::draw(chain, random);
    const Transform tip = chain.forward(q);
    const auto arcs = arm->arcs(tip);
    for (int s = 0; s < 128; ++s) {
      const double swivel = s == 0 ? arm->swivel(q) : random.between(-kPi, kPi);
      for (std::size_t b = 0; b < SrsBranch::kCount; ++b) {
        const SrsBranch branch = SrsBranch::number(b);
        bool inside = false, at_end = false;
        for (const SwivelArc& arc : arcs) {
          if (arc.branch != branch) continue;
          inside = inside || covers(arc, swivel, 0.0);
          at_end = at_end || (covers(arc, swivel, 1e-7) != covers(arc, swivel, -1e-7));
        }
        if (at_end) continue;
        ASSERT_EQ(arm->solve(tip, swivel, branch).has_value(), inside)
            << "pose " << k << " branch " << b << " swivel " << swivel;
      }
    }
    bool own = false;
    for (const SwivelArc& arc : arcs)
      own = own || (arc.branch == arm->branch(q) && covers(arc, arm->swivel(q), 1e-7));
    ASSERT_TRUE(own);
  }
}

TEST(SwivelArcs, WhenManySwivelsAreTried_ThenThoseWithSolutionsAreExactlyInTheArcs) {
  expect_arcs_as_sampled(tests::own_arm("right"), 11, 150);
  expect_arcs_as_sampled(tests::arm_with_elbow_aside(), 12, 100);
  expect_arcs_as_sampled(tests::arm_with_elbow_aside(0.9), 13, 100);
  expect_arcs_as_sampled(tests::arm_with_cardan_shoulder(), 14, 100);
}

TEST(SwivelArcs, WhenAnArcEnds_ThenAJointIsAtItsLimitOrTheArmIsSingular) {
  const Chain chain = tests::own_arm("left");
  const auto arm = SrsArm::recognise(chain);
  Random random(15);
  int ends = 0;
  for (int k = 0; k < 300; ++k) {
    const Transform tip = chain.forward(tests::draw(chain, random));
    for (const SwivelArc& arc : arm->arcs(tip)) {
      if (arc.to_rad - arc.from_rad > 2.0 * kPi - 1e-9) continue;
      for (const double end : {arc.from_rad, arc.to_rad}) {
        const auto at = arm->solve(tip, end, arc.branch, false);
        ASSERT_TRUE(at);
        double nearest = std::min(std::abs(std::sin(at->q[1])), std::abs(std::sin(at->q[5])));
        for (std::size_t j = 0; j < 7; ++j)
          for (const double limit : {chain.joints()[j].lower, chain.joints()[j].upper})
            nearest = std::min(nearest, std::abs(wrapped(at->q[j] - limit)));
        ASSERT_LT(nearest, 1e-6);
        ++ends;
      }
    }
  }
  EXPECT_GT(ends, 500);
}

TEST(SwivelArcs, WhenNoLimitIsThere_ThenEveryBranchHasTheWholeTurn) {
  const Chain chain = tests::seven_joints("zyzyzyz", {{}, {}, {}, {0, 0, 0.4}, {0, 0, 0.4}, {}, {}}, 3.2);
  const auto arm = SrsArm::recognise(chain);
  const auto arcs = arm->arcs(chain.forward(std::array{0.1, 0.5, 0.2, 1.0, -0.3, 0.7, 0.4}));
  ASSERT_EQ(arcs.size(), 8u);
  for (const SwivelArc& arc : arcs) EXPECT_NEAR(arc.to_rad - arc.from_rad, 2.0 * kPi, 1e-8);
}

}  // namespace
}  // namespace stepwright::motion
