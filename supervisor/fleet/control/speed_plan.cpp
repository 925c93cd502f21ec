#include "supervisor/fleet/control/speed_plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "supervisor/vehicle/greatest_speeds.h"

namespace stepwright::fleet {
namespace {

using vehicle::kSteeringWindow_m;

constexpr double kStep_m = 0.1;
constexpr double kTick_s = 0.02;

// The speed from which it stops within the way, if braking begins with the next tick.
double stoppable_m_s(double way_m, double brake_m_s2) {
  const double way = std::max(0.0, way_m);
  return brake_m_s2 * (std::sqrt(kTick_s * kTick_s + 2.0 * way / brake_m_s2) - kTick_s);
}

double turn_rad(const Leg& leg, double arc_m) {
  return leg.at(arc_m + kSteeringWindow_m / 2.0).lock_rad - leg.at(arc_m - kSteeringWindow_m / 2.0).lock_rad;
}

}  // namespace

SpeedPlan::SpeedPlan(const Leg& leg, const DriveLimits& limits)
    : limits_(limits), begin_m_(leg.begin_m()), end_m_(leg.end_m()) {
  const auto steps = static_cast<std::size_t>(std::ceil((end_m_ - begin_m_) / kStep_m));
  step_m_ = (end_m_ - begin_m_) / static_cast<double>(std::max<std::size_t>(1, steps));
  std::vector<vehicle::SpeedStation> stations;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double arc_m = begin_m_ + static_cast<double>(k) * step_m_;
    stations.push_back({.sharpest_1_m = leg.sharpest_1_m(arc_m - step_m_, arc_m + step_m_),
                        .turn_rad = turn_rad(leg, arc_m),
                        .to_next_m = step_m_});
  }
  ceiling_m_s_ = vehicle::greatest_speeds(stations, {.top_speed_m_s = limits.top_speed_m_s,
                                                     .brake_m_s2 = limits.brake_m_s2,
                                                     .lateral_m_s2 = limits.lateral_m_s2,
                                                     .lock_rate_rad_s = limits.lock_rate_rad_s});
}

double SpeedPlan::ceiling_m_s(double arc_m) const {
  const double place =
      std::clamp((arc_m - begin_m_) / step_m_, 0.0, static_cast<double>(ceiling_m_s_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(place), ceiling_m_s_.size() - 2);
  const double part = place - static_cast<double>(k);
  // Braking is linear in the square of the speed.
  const double a = ceiling_m_s_[k] * ceiling_m_s_[k];
  const double b = ceiling_m_s_[k + 1] * ceiling_m_s_[k + 1];
  return std::sqrt(a + part * (b - a));
}

double SpeedPlan::allowed_m_s(const Progress& at, const Clearance& clearance) const {
  double allowed =
      std::min(ceiling_m_s(at.arc_m), stoppable_m_s(clearance.permitted_m - at.arc_m, limits_.brake_m_s2));
  for (const Gate& gate : clearance.gates) {
    if (gate.arc_m <= at.arc_m) continue;
    if (gate.not_before_s > at.time_s) {
      allowed = std::min(allowed, (gate.arc_m - at.arc_m) / (gate.not_before_s - at.time_s));
    }
    break;  // what is behind it is no reason to hold up others before it
  }
  return allowed;
}

Progress SpeedPlan::advance(const Progress& from, double seconds, const Clearance& clearance) const {
  Progress now = from;
  for (double left_s = seconds; left_s > 1e-9; left_s -= kTick_s) {
    const double tick_s = std::min(kTick_s, left_s);
    const double allowed = allowed_m_s(now, clearance);
    const double speed = std::clamp(allowed, now.speed_m_s - limits_.brake_m_s2 * tick_s,
                                    now.speed_m_s + limits_.speed_up_m_s2 * tick_s);
    now.speed_m_s = std::max(0.0, speed);
    now.arc_m = std::min(now.arc_m + now.speed_m_s * tick_s, end_m_);
    now.time_s += tick_s;
  }
  return now;
}

}  // namespace stepwright::fleet
