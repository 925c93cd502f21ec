#pragma once

// A part of a path between two places where the arm rests, cut into intervals, with what the joints' limits
// mean for the motion along it.
//
// With b = (ds/dt)^2, a = d2s/dt2 = b'/2 and g = a' (derivatives by s) a joint's acceleration is
// q'' b + q' a, and its jerk sqrt(b) (q''' b + 3 q'' a + q' g): linear in b, a, g but for the root. Values;
// any thread.

#include <cstddef>
#include <vector>

#include "supervisor/motion/blend/blended_path.h"
#include "supervisor/motion/timing/limits.h"

namespace stepwright::motion::internal {

// Derivatives of a joint by s, over its limit.
struct LimitRow {
  double first = 0.0, second = 0.0, third = 0.0;
};

// One end of an interval; q''' is that of the interval.
struct GridEnd {
  double most_b = 0.0;                 // by the limits of velocity
  std::vector<LimitRow> acceleration;  // |second b + first a| <= 1
  // 0: limits of jerk are kept here. Else they may be exceeded for a price: so much for each 1 / sqrt(b) by
  // which the greatest |third b + 3 second a + first g| is above 1 / sqrt(b). For bounds.
  double price = 0.0;
  std::vector<LimitRow> jerk;  // sqrt(b) |third b + 3 second a + first g| <= 1
};

struct GridInterval {
  std::size_t piece = 0;  // of the path
  double begin = 0.0, end = 0.0;
  GridEnd left, right;
  double length() const { return end - begin; }
};

// Intervals one after the other; the arm rests before the first one and after the last one. At least 3. The
// first and the last lie on straight parts and are passed with constant jerk; most_b of their inner ends says
// what that jerk allows, too.
using SpeedGrid = std::vector<GridInterval>;

// Pieces `first` to `last` - 1 of the path. Requires that the first and the last of them are straight (the
// same one, perhaps). `fineness`: 1 for planning; more for bounds, as many times finer.
SpeedGrid speed_grid(const BlendedPath& path, std::size_t first, std::size_t last, const JointLimits& limits,
                     int fineness);

// What the limits mean along a straight part.
AxisLimits along_straight(const BlendedPath& path, const PathPiece& piece, const JointLimits& limits);

}  // namespace stepwright::motion::internal
