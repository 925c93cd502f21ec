#pragma once

// The time law of a blended path: as fast as the joints' limits of velocity, acceleration and jerk allow,
// from rest to rest, all joints together (doc: supervisor/doc/motion_timing.md).
//
//   const auto path = blend(way_points, {.tolerance = 0.05}, free);
//   const auto law = plan_timing(*path, {.velocity = {...}, .acceleration = {...}, .jerk = {...}});
//   law->duration(); law->at(0.5).place;
//
// Straight motions are exact: the double S, shortest within the limits. Between stops a path with blends is
// optimised (internal/speed_optimiser.h), then every limit is proved to be kept, by bounds on the polynomials
// of all joints in time, and the time is stretched by what is missing. Functions without state; any thread;
// the same on every machine.

#include "runtime/ground/result/result.h"
#include "supervisor/motion/blend/blended_path.h"
#include "supervisor/motion/timing/limits.h"
#include "supervisor/motion/timing/time_law.h"

namespace stepwright::motion {

// Errors A0502, A0505.
[[nodiscard]] result::Result<TimeLaw> plan_timing(const BlendedPath& path, const JointLimits& limits);

// A straight motion of two way-points from a speed along it, in s a second, to rest: going on after a hold or
// with another override. Errors A0501 to A0506.
[[nodiscard]] result::Result<TimeLaw> plan_straight(const Configuration& from, const Configuration& to,
                                                    const JointLimits& limits, double start_speed = 0.0);

// What there is to compare a time law with, on a grid `fineness` times as fine as the one that is planned on:
// (ds/dt)^2 is a positive quadratic in each interval, limits are kept at its ends. (A straight motion: no
// grid, both are the exact optimum.)
struct TimingBound {
  double seconds = 0.0;  // proved: no such motion is shorter, wherever its minimum lies
  double minimum = 0.0;  // what the optimiser finds: a minimum of those nearby
  bool proved = false;   // false: for parts of the path without a proof `seconds` has the minimum
};
[[nodiscard]] result::Result<TimingBound> bound_timing(const BlendedPath& path, const JointLimits& limits,
                                                       int fineness = 4);

}  // namespace stepwright::motion
