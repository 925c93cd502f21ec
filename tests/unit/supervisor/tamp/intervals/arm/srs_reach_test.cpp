#include "supervisor/tamp/intervals/arm/srs_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/supervisor/motion/kinematics/arms.h"

namespace stepwright::tamp {
namespace {

constexpr double kPi = std::numbers::pi;

// A tool that hangs down, with its x axis at an angle.
motion::Transform hanging(motion::Vector3 at, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {motion::from_columns({c, s, 0}, {s, -c, 0}, {0, 0, -1}), at};
}

Point3 point_of(motion::Vector3 at) {
  return {nanometres_of(at.x), nanometres_of(at.y), nanometres_of(at.z)};
}

bool is_reached(const motion::SrsArm& arm, const motion::Transform& tip) {
  return !arm.arcs(tip).empty();
}

TEST(Real, WhenOperationsAreRandom_ThenResultsAreWithin) {
  motion::Random random(3);
  for (int k = 0; k < 20'000; ++k) {
    const double a = random.between(-3.0, 3.0), b = random.between(-3.0, 3.0);
    const Real x{a - random.between(0.0, 0.5), a + random.between(0.0, 0.5)};
    const Real y{b - random.between(0.0, 0.5), b + random.between(0.0, 0.5)};
    ASSERT_TRUE((x * y).contains(a * b) && (x - y).contains(a - b) && square_of(x).contains(a * a));
    ASSERT_TRUE(cosine_of(x).contains(std::cos(a)) && sine_of(x).contains(std::sin(a)));
    const Real angle = angle_of(y, x);
    const double turn = 2.0 * kPi * std::round((angle.middle() - std::atan2(b, a)) / (2.0 * kPi));
    ASSERT_TRUE(angle.contains(std::atan2(b, a) + turn)) << a << " " << b;
    ASSERT_TRUE(x.contains(0.0) || inverse_of(x).contains(1.0 / a));
  }
}

// Whatever the exact arcs of the swivel reach must be within the bounds; the rest of the bounds is measured.
void expect_sound(const motion::Chain& chain, std::uint64_t seed, double half_cell_m) {
  const auto arm = motion::SrsArm::recognise(chain);
  const auto reach = SrsReach::make(chain);
  ASSERT_TRUE(arm && reach);
  const motion::Vector3 shoulder = arm->shoulder_m();
  motion::Random random(seed);
  int reached = 0, outside = 0, bounded = 0, poses = 0;
  for (int box = 0; box < 250; ++box) {
    const motion::Vector3 at{shoulder.x + random.between(-0.7, 0.9), shoulder.y + random.between(-0.8, 0.8),
                             shoulder.z + random.between(-1.0, 0.5)};
    const Point3 middle = point_of(at);
    const std::int64_t half = nanometres_of(half_cell_m);
    Box cell;
    for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] = {middle[axis] - half, middle[axis] + half};
    const ArcSet bounds = reach->arcs_over(cell);
    for (int k = 0; k < 20; ++k) {
      const motion::Vector3 tool = at + motion::Vector3{random.between(-half_cell_m, half_cell_m),
                                                        random.between(-half_cell_m, half_cell_m),
                                                        random.between(-half_cell_m, half_cell_m)};
      const double angle = random.between(-kPi, kPi);
      const bool within = bounds.contains(angle_of(angle));
      const bool is = is_reached(*arm, hanging(tool, angle));
      ++poses;
      reached += is;
      bounded += within;
      outside += is && !within;
    }
  }
  EXPECT_EQ(outside, 0) << "of " << reached;
  EXPECT_GT(reached, 500);
  EXPECT_LT(bounded, poses * 6 / 10) << "bounds that say something";
}

TEST(SrsReach, WhenPosesAreReached_ThenNoneIsOutsideOfTheBounds) {
  expect_sound(motion::tests::own_arm("right"), 21, 0.01);
  expect_sound(motion::tests::own_arm("left"), 22, 0.02);
  expect_sound(motion::tests::own_arm("left"), 23, 0.0);
}

TEST(SrsReach, WhenTheToolDoesNotTurnAboutTheLastAxis_ThenNothingIsMade) {
  EXPECT_FALSE(SrsReach::make(motion::tests::arm_with_elbow_aside())) << "its tool is askew";
}

// A table of a base that stands elsewhere is that of the base, moved.
TEST(SrsReach, WhenTheBaseIsMoved_ThenItsTableIs) {
  const auto reach = SrsReach::make(motion::tests::own_arm("left"));
  ASSERT_TRUE(reach);
  const Point3 moved{nanometres_of(1.2), nanometres_of(-0.6), nanometres_of(0.3)};
  const ReachTable here = reach->table(0.15), there = reach->table(0.15, moved);
  ASSERT_EQ(here.grid().size(), there.grid().size());
  std::size_t reached = 0;
  for (std::size_t cell = 0; cell < here.grid().size(); ++cell) {
    ASSERT_TRUE(std::ranges::equal(here.arcs(cell), there.arcs(cell)));
    reached += here.arcs(cell).empty() ? 0 : 1;
  }
  EXPECT_GT(reached, 100u);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(there.grid().origin_nm[axis], here.grid().origin_nm[axis] + moved[axis]);
}

}  // namespace
}  // namespace stepwright::tamp
