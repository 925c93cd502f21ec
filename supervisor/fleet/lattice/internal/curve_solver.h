#pragma once

// The shortest curves of a kind between two vertices of the lattice. Pure functions.

#include <optional>

#include "supervisor/fleet/lattice/motion_primitive.h"

namespace stepwright::fleet::internal {

struct CurveLimits {
  double resolution_m = 0.2;
  double min_radius_m = 3.5;
};

// Straight line, arc, straight line from `heading` to `heading + change`; change is -2, -1, 1 or 2. Costs are
// left open.
MotionPrimitive solve_turn(int heading, int change, const CurveLimits& limits);

// Two arcs of the same radius to the next line of vertices on the left or the right, with the heading of the
// start at the end.
MotionPrimitive solve_shift(int heading, bool to_the_left, const CurveLimits& limits);

// Straight ahead by `steps` times the heading's vector.
MotionPrimitive straight_line(int heading, int steps, const CurveLimits& limits);

}  // namespace stepwright::fleet::internal
