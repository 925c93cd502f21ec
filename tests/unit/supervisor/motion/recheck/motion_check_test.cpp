#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/exact_scenes.h"

namespace stepwright::motion {
namespace {

using Kind = MotionVerdict::Kind;

std::vector<double> at_share(std::span<const double> from, std::span<const double> to, double share) {
  std::vector<double> q(from.begin(), from.end());
  for (std::size_t k = 0; k < q.size(); ++k) q[k] += share * (to[k] - from[k]);
  return q;
}

// A verdict against places all along the motion, and at the place that it names.
void expect_verdicts_true(const tests::Scene& scene, std::uint64_t seed, int motions, double longest) {
  const ExactChecker exact = tests::exact_of(scene), with_spheres = tests::exact_of(scene, true);
  Random random(seed);
  int free = 0, colliding = 0;
  for (int k = 0; k < motions; ++k) {
    const auto from = tests::draw_rows(scene, 1, random);
    if (exact.contact(from)) continue;
    const auto to = at_share(from, tests::draw_rows(scene, 1, random), longest);
    const MotionVerdict verdict = exact.check_motion(from, to);
    ASSERT_EQ(with_spheres.check_motion(from, to).kind, verdict.kind);
    ASSERT_EQ(with_spheres.contact(to).has_value(), exact.contact(to).has_value());
    if (verdict.kind == Kind::Free) {
      ++free;
      for (int s = 0; s <= 60; ++s) ASSERT_FALSE(exact.contact(at_share(from, to, s / 60.0)));
    } else if (verdict.kind == Kind::Collides) {
      ++colliding;
      const auto there = exact.contact(at_share(from, to, verdict.share));
      ASSERT_TRUE(there);
      ASSERT_FALSE(verdict.contact.link.empty());
    }
  }
  EXPECT_GT(free, 3);
  EXPECT_GT(colliding, 3);
}

TEST(MotionCheck, WhenMotionsAreDrawn_ThenFreeOnesAreFreeAllAlong) {
  expect_verdicts_true(tests::own_scene("right_arm"), 1, 200, 0.7);
}

TEST(MotionCheck, WhenARobotHasMeshes_ThenFreeOnesAreFreeAllAlong) {
  auto scene = tests::panda_scene();
  if (!scene) GTEST_SKIP() << "data/arms is not on this machine";
  expect_verdicts_true(*scene, 2, 24, 0.6);
}

class Slide : public ::testing::Test {
 protected:
  MotionVerdict check(double from, double to, double thickness, double gap) {
    const auto robot = read_urdf(
        R"(<robot name="r"><link name="a"/><link name="b"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
      <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="-4" upper="4"/></joint></robot>)",
        "r.urdf");
    World world;
    world.obstacles = {box("sheet", {{}, {1, 0.05 + gap + 0.5, 0}}, {thickness, 1, 1})};
    const std::vector<int> coordinates{0};
    const std::vector<double> rest{0.0};
    const auto exact =
        ExactChecker::make(*robot, *read_bodies(*robot, MeshLocator(".")), nullptr, world, coordinates, rest);
    return exact->check_motion(std::vector{from}, std::vector{to});
  }
};

TEST_F(Slide, WhenAThinSheetIsInTheWay_ThenItIsFoundBetweenThePlacesThatASampleTries) {
  const MotionVerdict verdict = check(-3, 3, 1e-4, -0.05);
  EXPECT_EQ(verdict.kind, Kind::Collides);
  EXPECT_NEAR(verdict.share, 4.0 / 6.0, 0.02);
  EXPECT_EQ(verdict.contact.other, "sheet");
  EXPECT_EQ(check(-3, 0.5, 1e-4, -0.05).kind, Kind::Free);
  EXPECT_EQ(check(1, 1, 1e-4, -0.05).kind, Kind::Collides);
}

TEST_F(Slide, WhenItPassesByCloser_ThenItIsFreeUntilDistancesCannotBeTrusted) {
  EXPECT_EQ(check(-3, 3, 0.1, 1e-3).kind, Kind::Free);
  EXPECT_EQ(check(-3, 3, 0.1, 1e-6).kind, Kind::TooClose);
}

}  // namespace
}  // namespace stepwright::motion
