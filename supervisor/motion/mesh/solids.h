#pragma once

// Boxes and cylinders as triangles. Functions without state; any thread.

#include "supervisor/motion/mesh/triangle_mesh.h"

namespace stepwright::motion {

// Exact, its centre at the origin; full sides.
TriangleMesh box_mesh(Vector3 size_m);
// A prism of `sides` around the cylinder along z, which contains it: its sides touch the cylinder.
TriangleMesh prism_around_cylinder(double radius_m, double length_m, std::uint32_t sides = 32);

}  // namespace stepwright::motion
