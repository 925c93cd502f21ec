#pragma once

// A short motion from a vertex of the lattice to another one: the edges of the search.
//
// A value. Made of straight lines and arcs of circles, so that where it leads is known in closed form.
//
//   const geometry::Pose middle = pose_along(primitive, 0.5 * primitive.length_m);  // from vertex (0, 0)

#include <array>
#include <cstdint>

#include "supervisor/fleet/lattice/heading.h"
#include "supervisor/geometry/path.h"

namespace stepwright::fleet {

// Poses of a path are no farther apart than this, unless somebody asks for more.
inline constexpr double kPathSample_m = 0.05;

struct Segment {
  double length_m = 0.0;
  double curvature_1pm = 0.0;  // of the track as it is driven; positive to the left
};

struct MotionPrimitive {
  int start_heading = 0;
  int end_heading = 0;
  GridVector end;  // from the vertex at which it begins
  geometry::Travel travel = geometry::Travel::Forward;
  std::array<Segment, 3> segments;  // in the order in which they are driven; unused ones are empty
  double length_m = 0.0;
  std::uint32_t cost_mm = 0;  // length times factor, rounded up

  bool straight() const { return start_heading == end_heading && segments[1].length_m == 0.0; }
};

// The pose after `arc_m` of the way, 0 to length_m, for a start at vertex (0, 0).
geometry::Pose pose_along(const MotionPrimitive& primitive, double arc_m);

}  // namespace stepwright::fleet
