#include "plant_models/assemblies/forklift_equations.h"

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
namespace {

// The spring brake is dry friction; near standstill it is taken as smooth, over this time.
constexpr double kBrakeSettle_s = 0.02;

}  // namespace

ForkliftEquations::ForkliftEquations(const ForkliftParameters& parameters)
    : parameters_(parameters), full_lock_rad_(full_lock_rad(parameters)) {}

double ForkliftEquations::ground_speed_m_s(std::span<const double> y) const {
  const double slip = std::min(1.0, parameters_.slip.drive_slip + modes.extra_slip);
  return (1.0 - slip) * y[kForkliftWheel];
}

double ForkliftEquations::curvature_1_m(std::span<const double> y) const {
  const double speed = ground_speed_m_s(y);
  const double understeer =
      parameters_.slip.understeer_s2_m2 + parameters_.slip.load_understeer_s2_m2_kg * modes.load_kg;
  return std::tan(y[kForkliftLock]) / (parameters_.body.wheelbase_m * (1.0 + understeer * speed * speed));
}

// The controller asks for a force that would settle the speed with its time constant; what the motor can give
// depends on whether it drives or brakes.
double ForkliftEquations::wheel_acceleration(double wheel_m_s) const {
  const ForkliftDrive& drive = parameters_.drive;
  const double mass = drive.empty_mass_kg + modes.load_kg;
  const double target =
      modes.enabled ? std::clamp(modes.speed_m_s, -drive.top_speed_m_s, drive.top_speed_m_s) : 0.0;
  const double wanted = (target - wheel_m_s) / (modes.enabled ? drive.time_constant_s : kBrakeSettle_s);
  const bool brakes = wanted * wheel_m_s < 0.0;
  double force = brakes ? drive.brake_force_n : modes.drive_strength * drive.drive_force_n;
  if (!modes.enabled) force = drive.parking_brake_n;
  return std::clamp(wanted, -force / mass, force / mass);
}

void ForkliftEquations::derivative(double, std::span<const double> y, std::span<double> dydt) const {
  const double speed = ground_speed_m_s(y);
  const double target = std::clamp(modes.lock_rad, -full_lock_rad_, full_lock_rad_);
  const double rate = parameters_.steering.rate_rad_s;
  const double turn =
      std::clamp((target - y[kForkliftLock]) / parameters_.steering.time_constant_s, -rate, rate);
  dydt[kForkliftX] = speed * std::cos(y[kForkliftHeading]);
  dydt[kForkliftY] = speed * std::sin(y[kForkliftHeading]);
  dydt[kForkliftHeading] = speed * curvature_1_m(y);
  dydt[kForkliftWheel] = wheel_acceleration(y[kForkliftWheel]);
  dydt[kForkliftLock] = modes.steering_stuck ? 0.0 : turn;
  dydt[kForkliftTravel] = std::abs(y[kForkliftWheel]);
}

}  // namespace stepwright::assemblies
