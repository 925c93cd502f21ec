#include "supervisor/fleet/lattice/motion_primitive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::fleet {

namespace {

using geometry::Pose;

// `pose.heading_rad` is the direction of travel here. Along an arc the chord has half the turn.
Pose advance(const Pose& pose, double length_m, double curvature_1pm) {
  const double turn = length_m * curvature_1pm;
  const double chord = turn == 0.0 ? length_m : 2.0 * std::sin(0.5 * turn) / curvature_1pm;
  const double direction = pose.heading_rad + 0.5 * turn;
  return {pose.x_m + chord * std::cos(direction), pose.y_m + chord * std::sin(direction),
          pose.heading_rad + turn};
}

}  // namespace

Pose pose_along(const MotionPrimitive& primitive, double arc_m) {
  const double backwards = primitive.travel == geometry::Travel::Reverse ? std::numbers::pi : 0.0;
  Pose pose{0.0, 0.0, heading_rad(primitive.start_heading) + backwards};
  double left_m = arc_m;
  for (const Segment& segment : primitive.segments) {
    const double length_m = std::min(left_m, segment.length_m);
    pose = advance(pose, length_m, segment.curvature_1pm);
    left_m -= length_m;
  }
  pose.heading_rad = std::remainder(pose.heading_rad - backwards, 2.0 * std::numbers::pi);
  return pose;
}

}  // namespace stepwright::fleet
