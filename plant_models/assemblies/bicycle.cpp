#include "plant_models/assemblies/bicycle.h"

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
namespace {

// The spring brake is dry friction; near standstill it is taken as smooth, over this time.
constexpr double kBrakeSettle_s = 0.02;

}  // namespace

BicycleModes commanded(const BicycleModes& modes, bool enabled, double speed_m_s, double lock_rad) {
  BicycleModes changed = modes;
  changed.enabled = enabled && std::isfinite(speed_m_s) && std::isfinite(lock_rad);
  changed.speed_m_s = changed.enabled ? speed_m_s : 0.0;
  changed.lock_rad = changed.enabled ? lock_rad : modes.lock_rad;
  return changed;
}

double Bicycle::ground_speed_m_s(const BicycleModes& modes, std::span<const double> y) const {
  const double slip = std::min(1.0, figures_.drive_slip + modes.extra_slip);
  return (1.0 - slip) * y[kBicycleWheel];
}

double Bicycle::curvature_1_m(const BicycleModes& modes, std::span<const double> y) const {
  const double speed = ground_speed_m_s(modes, y);
  const double understeer = figures_.understeer_s2_m2 + figures_.load_understeer_s2_m2_kg * modes.load_kg;
  return std::tan(y[kBicycleLock]) / (figures_.wheelbase_m * (1.0 + understeer * speed * speed));
}

// The controller asks for a force that would settle the speed with its time constant; what the motor can give
// depends on whether it drives or brakes.
double Bicycle::wheel_acceleration(const BicycleModes& modes, double wheel_m_s) const {
  const double mass = figures_.empty_mass_kg + modes.load_kg;
  const double target =
      modes.enabled ? std::clamp(modes.speed_m_s, -figures_.top_speed_m_s, figures_.top_speed_m_s) : 0.0;
  const double wanted = (target - wheel_m_s) / (modes.enabled ? figures_.time_constant_s : kBrakeSettle_s);
  const bool brakes = wanted * wheel_m_s < 0.0;
  double force = brakes ? figures_.brake_force_n : modes.drive_strength * figures_.drive_force_n;
  if (!modes.enabled) force = figures_.parking_brake_n;
  return std::clamp(wanted, -force / mass, force / mass);
}

void Bicycle::derivative(const BicycleModes& modes, std::span<const double> y, std::span<double> dydt) const {
  const double speed = ground_speed_m_s(modes, y);
  const double target = std::clamp(modes.lock_rad, -figures_.full_lock_rad, figures_.full_lock_rad);
  const double rate = figures_.lock_rate_rad_s;
  const double turn = std::clamp((target - y[kBicycleLock]) / figures_.lock_time_constant_s, -rate, rate);
  dydt[kBicycleX] = speed * std::cos(y[kBicycleHeading]);
  dydt[kBicycleY] = speed * std::sin(y[kBicycleHeading]);
  dydt[kBicycleHeading] = speed * curvature_1_m(modes, y);
  dydt[kBicycleWheel] = wheel_acceleration(modes, y[kBicycleWheel]);
  dydt[kBicycleLock] = modes.steering_stuck ? 0.0 : turn;
  dydt[kBicycleTravel] = std::abs(y[kBicycleWheel]);
}

}  // namespace stepwright::assemblies
