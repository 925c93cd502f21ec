#include "supervisor/motion/timing/limits.h"

#include "supervisor/motion/blend/codes.h"

namespace stepwright::motion {

JointLimits scaled(JointLimits limits, double velocity, double acceleration, double jerk) {
  for (double& each : limits.velocity) each *= velocity;
  for (double& each : limits.acceleration) each *= acceleration;
  for (double& each : limits.jerk) each *= jerk;
  return limits;
}

result::Result<void> check_limits(const JointLimits& limits, std::size_t joints) {
  constexpr double kLeast = 1e-6, kMost = 1e9;
  const auto check = [&](const std::vector<double>& values, const char* name) -> result::Result<void> {
    if (values.size() != joints)
      return result::fail(code::kJointCount, {},
                          std::string("limits of ") + name + " for " + std::to_string(values.size()) +
                              " joints, the path has " + std::to_string(joints));
    for (std::size_t j = 0; j < joints; ++j)
      if (!(values[j] >= kLeast && values[j] <= kMost))
        return result::fail(code::kBadLimit, {},
                            "joint " + std::to_string(j + 1) + ": the limit of " + name + " is " +
                                std::to_string(values[j]) + ", it must be from 1e-6 to 1e9");
    return {};
  };
  if (auto sound = check(limits.velocity, "velocity"); !sound) return sound;
  if (auto sound = check(limits.acceleration, "acceleration"); !sound) return sound;
  return check(limits.jerk, "jerk");
}

}  // namespace stepwright::motion
