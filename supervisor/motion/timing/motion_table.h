#pragma once

// A motion as numbers that a function block interpolates, override and stops included (doc:
// supervisor/doc/motion_timing.md, which has the block's side of it).
//
//   const auto table = motion_table(*path, *law, limits, stop_limits(limits), {.rows = 500});
//
// Values; any thread.

#include <cstddef>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/blend/blended_path.h"
#include "supervisor/motion/timing/limits.h"
#include "supervisor/motion/timing/time_law.h"

namespace stepwright::motion {

// What joints may do while the override changes; one number a joint, above those that were planned with.
struct StopLimits {
  std::vector<double> acceleration, jerk;
};
StopLimits stop_limits(const JointLimits& planned, double acceleration = 1.5, double jerk = 3.0);

// How fast the override may change, so that stop limits are kept anywhere on any path planned with `planned`.
struct OverrideRates {
  double per_s = 0.0, per_s2 = 0.0;

  // From as planned to rest.
  double stopping_time_s() const;
};
// Errors A0502, A0507.
[[nodiscard]] result::Result<OverrideRates> override_rates(const JointLimits& planned,
                                                           const StopLimits& stop);

// Room of a block.
struct TableCapacity {
  std::size_t joints = 14, way_points = 64, rows = 2048;
};

struct MotionTable {
  std::size_t joints = 0;
  std::vector<double> places, half_widths;  // S, H: one a way-point
  std::vector<double> points, directions;   // Q, U: way-points by joints, row by row
  std::vector<double> begins_s, rates;      // T (one more than rows), R
  std::vector<double> coefficients;         // C: rows by 6
  OverrideRates override_rates;             // RATE_D, RATE_DD

  std::size_t rows() const { return rates.size(); }
};

// Errors A0502, A0507, A0510. Requires a law of that path.
[[nodiscard]] result::Result<MotionTable> motion_table(const BlendedPath& path, const TimeLaw& law,
                                                       const JointLimits& limits, const StopLimits& stop,
                                                       const TableCapacity& capacity = {});

}  // namespace stepwright::motion
