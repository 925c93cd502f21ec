#include "supervisor/motion/mesh/solids.h"

#include <cmath>
#include <numbers>

namespace stepwright::motion {

TriangleMesh box_mesh(Vector3 size_m) {
  TriangleMesh box;
  for (unsigned k = 0; k < 8; ++k)
    box.points.push_back({(k & 1U ? 0.5 : -0.5) * size_m.x, (k & 2U ? 0.5 : -0.5) * size_m.y,
                          (k & 4U ? 0.5 : -0.5) * size_m.z});
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

TriangleMesh prism_around_cylinder(double radius_m, double length_m, std::uint32_t sides) {
  TriangleMesh prism;
  const double half_step = std::numbers::pi / sides, outer = radius_m / std::cos(half_step);
  for (std::uint32_t k = 0; k < sides; ++k) {
    const double angle = 2.0 * half_step * k;
    for (const double z : {-0.5 * length_m, 0.5 * length_m})
      prism.points.push_back({outer * std::cos(angle), outer * std::sin(angle), z});
  }
  for (const double z : {-0.5 * length_m, 0.5 * length_m}) prism.points.push_back({0, 0, z});
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % sides);
    prism.triangles.push_back({a, b, a + 1});
    prism.triangles.push_back({b, b + 1, a + 1});
    prism.triangles.push_back({2 * sides, b, a});
    prism.triangles.push_back({2 * sides + 1, a + 1, b + 1});
  }
  return prism;
}

}  // namespace stepwright::motion
