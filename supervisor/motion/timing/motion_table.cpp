#include "supervisor/motion/timing/motion_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "supervisor/motion/blend/codes.h"

namespace stepwright::motion {

StopLimits stop_limits(const JointLimits& planned, double acceleration, double jerk) {
  StopLimits stop{planned.acceleration, planned.jerk};
  for (double& each : stop.acceleration) each *= acceleration;
  for (double& each : stop.jerk) each *= jerk;
  return stop;
}

double OverrideRates::stopping_time_s() const {
  return per_s * per_s >= per_s2 ? 2.0 / std::sqrt(per_s2) : 1.0 / per_s + per_s / per_s2;
}

result::Result<OverrideRates> override_rates(const JointLimits& planned, const StopLimits& stop) {
  const std::size_t joints = planned.velocity.size();
  if (auto sound = check_limits(planned, joints); !sound) return result::forward(sound);
  if (stop.acceleration.size() != joints || stop.jerk.size() != joints)
    return result::fail(code::kJointCount, {},
                        "stop limits are for another number of joints than the planned ones");
  OverrideRates rates{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t j = 0; j < joints; ++j) {
    const double acceleration = stop.acceleration[j] - planned.acceleration[j],
                 jerk = stop.jerk[j] - planned.jerk[j];
    if (!(acceleration > 0.0) || !(jerk > 0.0) || !std::isfinite(acceleration) || !std::isfinite(jerk))
      return result::fail(
          code::kBadStopLimits, {},
          "joint " + std::to_string(j + 1) +
              ": the stop limits are not above the planned ones, so nothing is left for a stop",
          "plan with a fraction of the limits");
    // Half of the jerk that is left is for the change of the acceleration that the path has anyway.
    rates.per_s =
        std::min({rates.per_s, acceleration / planned.velocity[j], jerk / (6.0 * planned.acceleration[j])});
  }
  for (std::size_t j = 0; j < joints; ++j)
    rates.per_s2 = std::min(
        rates.per_s2,
        (stop.jerk[j] - planned.jerk[j] - 3.0 * planned.acceleration[j] * rates.per_s) / planned.velocity[j]);
  return rates;
}

result::Result<MotionTable> motion_table(const BlendedPath& path, const TimeLaw& law,
                                         const JointLimits& limits, const StopLimits& stop,
                                         const TableCapacity& capacity) {
  auto rates = override_rates(limits, stop);
  if (!rates) return result::forward(rates);
  const auto check = [](std::size_t needed, std::size_t room, const char* what) -> result::Result<void> {
    if (needed <= room) return {};
    return result::fail(code::kTableFull, {},
                        "the motion has " + std::to_string(needed) + " " + what +
                            ", the block has room for " + std::to_string(room));
  };
  if (auto fits = check(path.joints(), capacity.joints, "joints"); !fits) return result::forward(fits);
  if (auto fits = check(path.points().size(), capacity.way_points, "way-points"); !fits)
    return result::forward(fits);
  if (auto fits = check(law.rows.size(), capacity.rows, "rows"); !fits) return result::forward(fits);
  MotionTable table;
  table.joints = path.joints();
  table.places = path.places();
  table.half_widths = path.half_widths();
  for (const Configuration& each : path.points())
    table.points.insert(table.points.end(), each.begin(), each.end());
  for (const Configuration& each : path.directions())
    table.directions.insert(table.directions.end(), each.begin(), each.end());
  table.begins_s.push_back(0.0);
  for (const TimeRow& row : law.rows) {
    table.begins_s.push_back(table.begins_s.back() + row.duration);
    table.rates.push_back(1.0 / row.duration);
    table.coefficients.insert(table.coefficients.end(), row.c.begin(), row.c.end());
  }
  table.override_rates = *rates;
  return table;
}

}  // namespace stepwright::motion
