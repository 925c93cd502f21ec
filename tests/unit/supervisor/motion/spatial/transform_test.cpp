#include "supervisor/motion/spatial/transform.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace stepwright::motion {
namespace {

constexpr double kPi = std::numbers::pi;

class Draw {
 public:
  double in(double lower, double upper) { return std::uniform_real_distribution<>(lower, upper)(engine_); }
  Vector3 direction() {
    for (;;) {
      const Vector3 v{in(-1, 1), in(-1, 1), in(-1, 1)};
      if (length(v) > 0.1) return normalised(v);
    }
  }

 private:
  std::mt19937 engine_{1};
};

TEST(Transform, WhenAnAngleIsAnyUpToPi_ThenItsRotationVectorComesBack) {
  Draw draw;
  for (int k = 0; k < 20000; ++k) {
    const Vector3 axis = draw.direction();
    const double near[] = {draw.in(0, kPi), draw.in(0, 1e-7), kPi - draw.in(1e-9, 1e-7), draw.in(2.6, 3.1),
                           0.0};
    const double angle = near[k % 5];
    const Vector3 back = rotation_vector(about(axis, angle));
    ASSERT_LT(distance(back, angle * axis), 3e-8) << angle;
  }
}

TEST(Transform, WhenAnAngleIsPi_ThenTheAxisIsFoundButForItsSign) {
  const Vector3 axis = normalised({0.3, -0.5, 0.2});
  const Vector3 back = rotation_vector(about(axis, kPi));
  EXPECT_NEAR(std::abs(dot(normalised(back), axis)), 1.0, 1e-9);
  EXPECT_NEAR(length(back), kPi, 1e-9);
}

TEST(Transform, WhenRollPitchAndYawAreGiven_ThenTheAxesAreThoseOfTheParent) {
  const Rotation turned = from_rpy(0.0, 0.0, kPi / 2);
  EXPECT_LT(distance(turned * Vector3{1, 0, 0}, {0, 1, 0}), 1e-15);
  // Roll comes first, about x; then yaw turns what it made.
  EXPECT_LT(distance(from_rpy(kPi / 2, 0.0, kPi / 2) * Vector3{0, 1, 0}, {0, 0, 1}), 1e-15);
  EXPECT_LT(distance(from_rpy(0.0, kPi / 2, 0.0) * Vector3{1, 0, 0}, {0, 0, -1}), 1e-15);
}

TEST(Transform, WhenAQuaternionIsGiven_ThenItIsTheSameRotation) {
  Draw draw;
  for (int k = 0; k < 1000; ++k) {
    const Vector3 axis = draw.direction();
    const double angle = draw.in(-kPi, kPi), s = 2.0 * std::sin(angle / 2);
    const Rotation a = from_quaternion(2.0 * std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z);
    ASSERT_LT(angle_between(a, about(axis, angle)), 1e-7);
  }
}

TEST(Transform, WhenItIsMultipliedByItsInverse_ThenNothingMoves) {
  Draw draw;
  for (int k = 0; k < 1000; ++k) {
    const Transform a{about(draw.direction(), draw.in(-3, 3)),
                      {draw.in(-9, 9), draw.in(-9, 9), draw.in(-9, 9)}};
    const Transform none = a * inverse(a);
    ASSERT_LT(length(none.position_m), 1e-13);
    ASSERT_LT(length(rotation_vector(none.rotation)), 1e-13);
    const Vector3 p{draw.in(-1, 1), draw.in(-1, 1), draw.in(-1, 1)};
    ASSERT_LT(distance((a * a) * p, a * (a * p)), 1e-13);
  }
}

TEST(Transform, WhenANormalIsWanted_ThenItIsAtARightAngle) {
  Draw draw;
  for (int k = 0; k < 1000; ++k) {
    const Vector3 axis = draw.direction();
    ASSERT_NEAR(dot(any_normal(axis), axis), 0.0, 1e-15);
    ASSERT_NEAR(length(any_normal(axis)), 1.0, 1e-15);
  }
}

}  // namespace
}  // namespace stepwright::motion
