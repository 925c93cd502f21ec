#pragma once

// Exact reach of an arm at a point: bounds (reach_bounds.h) only say what it does not reach.
//
// Immutable; any thread.
//
//   if (right.reaches(at, angle)) ...                        // a posture within all limits exists
//   for (const Arc arc : right.near(at).arcs()) ...          // beyond these no angle is reached

#include "supervisor/tamp/intervals/reach/reach_bounds.h"

namespace stepwright::tamp {

class ExactReach {
 public:
  virtual ~ExactReach() = default;
  // Whether there is a posture for the tool at the point with this angle.
  virtual bool reaches(const Point3& at, Angle angle) const = 0;
  // All angles that it reaches there, and few others.
  virtual ArcSet near(const Point3& at) const = 0;
};

}  // namespace stepwright::tamp
