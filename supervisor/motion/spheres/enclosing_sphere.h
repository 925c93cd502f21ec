#pragma once

// The smallest sphere around points. A function without state; any thread.

#include <span>

#include "supervisor/motion/spatial/vector.h"

namespace stepwright::motion {

struct Sphere {
  Vector3 centre_m;
  double radius_m = 0.0;
};

// Contains every point for certain, and is the smallest but for about 1e-9 of its size. By exchange of the
// points that carry it (after Gaertner 1999, Fast and robust smallest enclosing balls). No points: a sphere
// of radius 0.
Sphere enclosing_sphere(std::span<const Vector3> points);

}  // namespace stepwright::motion
