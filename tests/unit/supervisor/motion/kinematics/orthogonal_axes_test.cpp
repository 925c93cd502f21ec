#include "supervisor/motion/kinematics/orthogonal_axes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {
namespace {

class AxesOfManyKinds : public ::testing::TestWithParam<double> {
 protected:
  // The third axis is the first one turned about the second by the parameter.
  const Rotation placed_ = from_rpy(0.3, -0.8, 1.1);
  const OrthogonalAxes axes_{placed_ * Vector3{0, 0, 1}, placed_* Vector3{0, 1, 0},
                             placed_*(about({0, 1, 0}, GetParam()) * Vector3{0, 0, 1})};
};

TEST_P(AxesOfManyKinds, WhenARotationIsGiven_ThenBothTriplesMakeIt) {
  Random random(3);
  for (int k = 0; k < 3000; ++k) {
    std::array<double, 3> q{};
    for (double& each : q) each = random.between(-std::numbers::pi, std::numbers::pi);
    if (k % 4 == 0)
      q[1] = -axes_.skew() + random.between(-1, 1) * (k % 8 == 0 ? 1e-7 : 1e-11);  // nearly singular
    const Rotation made = axes_.rotation(q);
    for (const bool flipped : {false, true})
      ASSERT_LT(angle_between(axes_.rotation(axes_.values(made, flipped)), made), 1e-12);
    if (std::abs(std::sin(q[1] + axes_.skew())) < 1e-3) continue;
    const auto again = axes_.values(made, axes_.flipped(q[1]));
    const auto other = axes_.values(made, !axes_.flipped(q[1]));
    for (std::size_t i = 0; i < 3; ++i) ASSERT_NEAR(wrapped(again[i] - q[i]), 0.0, 1e-10);
    ASSERT_GT(std::abs(wrapped(other[0] - q[0])), 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Skews, AxesOfManyKinds,
                         ::testing::Values(0.0, std::numbers::pi / 2, -1.0, std::numbers::pi));

}  // namespace
}  // namespace stepwright::motion
