#include "supervisor/vehicle/greatest_speeds.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stepwright::vehicle {
namespace {

constexpr double kSteeringShare = 0.8;  // of the rate, which leaves the controller some

double alone(const SpeedStation& at, const SpeedLimits& limits) {
  double speed = limits.top_speed_m_s;
  if (at.sharpest_1_m > 0.0) speed = std::min(speed, std::sqrt(limits.lateral_m_s2 / at.sharpest_1_m));
  const double turn = std::abs(at.turn_rad);
  if (turn > 0.0) speed = std::min(speed, kSteeringShare * limits.lock_rate_rad_s * kSteeringWindow_m / turn);
  return speed;
}

}  // namespace

std::vector<double> greatest_speeds(std::span<const SpeedStation> stations, const SpeedLimits& limits) {
  assert(!stations.empty());
  std::vector<double> speeds;
  for (const SpeedStation& at : stations) speeds.push_back(alone(at, limits));
  speeds.back() = 0.0;
  for (std::size_t k = speeds.size() - 1; k-- > 0;) {
    const double next = speeds[k + 1];
    speeds[k] = std::min(speeds[k], std::sqrt(next * next + 2.0 * limits.brake_m_s2 * stations[k].to_next_m));
  }
  return speeds;
}

}  // namespace stepwright::vehicle
