#include "supervisor/motion/mesh/triangle_mesh.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace stepwright::motion {

double winding_number(const TriangleMesh& mesh, Vector3 point) {
  // Solid angle of a triangle: van Oosterom and Strackee 1983.
  double half_angles = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.points[t[0]] - point, b = mesh.points[t[1]] - point, c = mesh.points[t[2]] - point;
    const double la = length(a), lb = length(b), lc = length(c);
    half_angles +=
        std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return half_angles / (2.0 * std::numbers::pi);
}

void turn_outwards(TriangleMesh& mesh) {
  if (mesh.points.empty()) return;
  const Vector3 from = mesh.points.front();
  double volume = 0.0;
  for (const auto& t : mesh.triangles)
    volume += dot(mesh.points[t[0]] - from, cross(mesh.points[t[1]] - from, mesh.points[t[2]] - from));
  if (volume < 0.0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

TriangleMesh moved(TriangleMesh mesh, const Transform& by) {
  for (Vector3& each : mesh.points) each = by * each;
  return mesh;
}

double area_m2(const std::array<Vector3, 3>& triangle) {
  return 0.5 * length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
}

}  // namespace stepwright::motion
