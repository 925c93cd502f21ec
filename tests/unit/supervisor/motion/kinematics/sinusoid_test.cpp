#include "supervisor/motion/kinematics/sinusoid.h"

#include <gtest/gtest.h>

#include <numbers>

#include "supervisor/motion/spatial/random.h"
#include "supervisor/motion/spatial/transform.h"

namespace stepwright::motion {
namespace {

TEST(Sinusoid, WhenItCrossesZero_ThenBothPlacesAreFound) {
  Random random(1);
  for (int k = 0; k < 5000; ++k) {
    const Sinusoid of{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const Roots found = roots(of);
    const double amplitude = std::hypot(of.with_cosine, of.with_sine);
    ASSERT_EQ(found.count, amplitude >= std::abs(of.constant) ? 2u : 0u);
    for (std::size_t r = 0; r < found.count; ++r) {
      ASSERT_NEAR(of.at(std::cos(found.angles[r]), std::sin(found.angles[r])), 0.0, 1e-14);
      ASSERT_GE(found.angles[r], -std::numbers::pi);
      ASSERT_LT(found.angles[r], std::numbers::pi);
    }
  }
  EXPECT_EQ(roots({0.5, 0.0, 0.0}).count, 0u);
  EXPECT_EQ(roots({1.0, 1.0 - 1e-14, 0.0}).count, 2u);  // touches but for rounding
}

TEST(Sinusoid, WhenAnAngleIsWrapped_ThenItIsWithinHalfATurn) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(wrapped(kPi), -kPi);
  EXPECT_EQ(wrapped(-kPi), -kPi);
  EXPECT_NEAR(wrapped(7.0), 7.0 - 2 * kPi, 1e-15);
  EXPECT_NEAR(wrapped(-100.0), -100.0 + 32 * kPi, 1e-13);
}

TEST(Sinusoid, WhenAVectorGoesRound_ThenItsCoordinatesAreSinusoids) {
  Random random(2);
  const Vector3 axis = normalised({1, -2, 0.5}), start{0.3, 0.1, -0.7}, along{0.2, 0.9, 0.4};
  const Sinusoid course = GoingRound(axis, start).along(along);
  for (int k = 0; k < 100; ++k) {
    const double t = random.between(-4, 4);
    EXPECT_NEAR(course.at(std::cos(t), std::sin(t)), dot(about(axis, t) * start, along), 1e-15);
  }
}

}  // namespace
}  // namespace stepwright::motion
