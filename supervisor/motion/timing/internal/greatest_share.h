#pragma once

// Share of its limits that a motion uses, as certain upper bounds: Bernstein's coefficients of the joints'
// speeds, accelerations and jerks as polynomials in time. Functions without state; any thread.

#include <span>

#include "supervisor/motion/blend/blended_path.h"
#include "supervisor/motion/timing/limits.h"
#include "supervisor/motion/timing/time_law.h"

namespace stepwright::motion::internal {

// Greatest quotients of values and limits. 1: the limit is met, and nowhere exceeded.
struct Share {
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;

  void raise(const Share& other);
  // By how much the time must be stretched (or may be shortened) so that the greatest is 1.
  double stretch() const;
};

Share greatest_share(const BlendedPath& path, const PathPiece& piece, const TimeRow& row,
                     const JointLimits& limits);

}  // namespace stepwright::motion::internal
