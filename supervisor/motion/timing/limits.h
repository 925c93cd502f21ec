#pragma once

// Limits of the joints of an arm. Values; any thread.

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::motion {

// One number a joint, all above zero: rad/s, rad/s^2, rad/s^3 (m for joints that slide), in both directions.
struct JointLimits {
  std::vector<double> velocity, acceleration, jerk;
};

// The same fraction of all of them.
JointLimits scaled(JointLimits limits, double velocity, double acceleration, double jerk);

// Errors A0502 and A0505, with the joint and the limit's name.
[[nodiscard]] result::Result<void> check_limits(const JointLimits& limits, std::size_t joints);

// Limits of one motion along a line: of its place, not of a joint.
struct AxisLimits {
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;
};

}  // namespace stepwright::motion
