#include "supervisor/motion/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include "supervisor/motion/mesh/solids.h"
#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {
namespace {

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += area_m2(mesh.corners(t));
  return sum;
}

TEST(TriangleMesh, WhenAPointIsInside_ThenTheSurfaceGoesRoundItOnce) {
  Random random(1);
  const TriangleMesh box = box_mesh({1, 2, 3}), prism = prism_around_cylinder(0.5, 2.0);
  for (int k = 0; k < 1000; ++k) {
    const Vector3 p{random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
    const bool in_box = std::abs(p.x) < 0.5 && std::abs(p.y) < 1.0 && std::abs(p.z) < 1.5;
    ASSERT_NEAR(winding_number(box, p), in_box ? 1.0 : 0.0, 1e-9);
    const double from_axis = std::hypot(p.x, p.y);
    if (from_axis > 0.49 && from_axis < 0.51) continue;
    ASSERT_NEAR(winding_number(prism, p), from_axis < 0.5 && std::abs(p.z) < 1.0 ? 1.0 : 0.0, 1e-9);
  }
}

TEST(TriangleMesh, WhenItIsInsideOut_ThenItIsTurned) {
  TriangleMesh box = moved(box_mesh({1, 1, 1}), {about({0, 0, 1}, 0.5), {5, 0, 0}});
  const TriangleMesh sound = box;
  turn_outwards(box);
  EXPECT_EQ(box.triangles, sound.triangles);
  for (auto& t : box.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(winding_number(box, {5, 0, 0}), -1.0, 1e-9);
  turn_outwards(box);
  EXPECT_NEAR(winding_number(box, {5, 0, 0}), 1.0, 1e-9);
}

TEST(TriangleMesh, WhenSolidsAreMade_ThenTheirSurfacesAreThoseOfTheShape) {
  EXPECT_NEAR(area(box_mesh({1, 2, 3})), 22.0, 1e-12);
  const TriangleMesh prism = prism_around_cylinder(0.5, 2.0);
  for (const Vector3& p : prism.points)
    if (p.x != 0.0 || p.y != 0.0) {
      EXPECT_GE(std::hypot(p.x, p.y), 0.5);
    }
  EXPECT_NEAR(area(prism), 2.0 * 3.14159265 * 0.5 * 2.5, 0.05);
}

}  // namespace
}  // namespace stepwright::motion
