#include "supervisor/motion/spheres/enclosing_sphere.h"

#include <gtest/gtest.h>

#include <vector>

#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {
namespace {

TEST(EnclosingSphere, WhenPointsAreRandom_ThenAllAreInsideAndNoSmallerOneWouldDo) {
  Random random(1);
  for (int k = 0; k < 300; ++k) {
    std::vector<Vector3> points(2 + random.below(60));
    for (Vector3& p : points)
      p = {random.between(-1, 1), random.between(-1, 1), k % 5 == 0 ? 0.0 : random.between(-3, 1)};
    const Sphere sphere = enclosing_sphere(points);
    for (const Vector3& p : points) ASSERT_LE(distance(p, sphere.centre_m), sphere.radius_m);
    // Smallest: moving the centre anywhere makes the farthest point farther.
    for (int d = 0; d < 40; ++d) {
      const Vector3 step{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      const Vector3 there = sphere.centre_m + (1e-3 / length(step)) * step;
      double farthest = 0.0;
      for (const Vector3& p : points) farthest = std::max(farthest, distance(p, there));
      ASSERT_GE(farthest, sphere.radius_m - 1e-8);
    }
  }
}

TEST(EnclosingSphere, WhenPointsAreFewOrAlike_ThenItIsKnown) {
  EXPECT_EQ(enclosing_sphere({}).radius_m, 0.0);
  const std::vector<Vector3> same(5, Vector3{1, 2, 3});
  EXPECT_LT(enclosing_sphere(same).radius_m, 1e-11);
  const std::vector<Vector3> two{{0, 0, 0}, {2, 0, 0}};
  EXPECT_NEAR(enclosing_sphere(two).radius_m, 1.0, 1e-9);
  std::vector<Vector3> cube;
  for (unsigned k = 0; k < 8; ++k) cube.push_back({double(k & 1U), double(k >> 1U & 1U), double(k >> 2U)});
  EXPECT_NEAR(enclosing_sphere(cube).radius_m, std::sqrt(3.0) / 2.0, 1e-9);
}

}  // namespace
}  // namespace stepwright::motion
