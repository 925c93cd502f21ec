#pragma once

// A body as the triangles of its surface. Values; any thread. Metres.
//
//   const bool inside = winding_number(mesh, point) > 0.5;

#include <array>
#include <cstdint>
#include <vector>

#include "supervisor/motion/spatial/transform.h"

namespace stepwright::motion {

struct TriangleMesh {
  std::vector<Vector3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // anticlockwise as seen from outside

  std::array<Vector3, 3> corners(std::size_t triangle) const {
    const auto& t = triangles[triangle];
    return {points[t[0]], points[t[1]], points[t[2]]};
  }
};

// How often the surface goes round the point: 1 inside of a closed body, 0 outside; between them where it has
// holes (Jacobson, Kavan, Sorkine-Hornung 2013, Robust inside-outside segmentation using generalized winding
// numbers). Its sign is the other one where the triangles are the wrong way round.
double winding_number(const TriangleMesh& mesh, Vector3 point);
// Turns all triangles round where the body's volume is below zero: a mesh that was mirrored, or is inside
// out.
void turn_outwards(TriangleMesh& mesh);
TriangleMesh moved(TriangleMesh mesh, const Transform& by);
double area_m2(const std::array<Vector3, 3>& triangle);

}  // namespace stepwright::motion
