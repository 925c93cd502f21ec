#pragma once

// The motion that vehicles with one steered axle have in common: a kinematic bicycle with a force-limited
// drive, a spring brake, a rate-limited steering and slip (plant_models/doc/forklift.md). Pure functions of
// figures, modes and state, SI units. Between two changes of the modes the equations are smooth except for
// the kinks of the limits, which the error control of the solver handles.
//
// Invariant: |steering angle| and |wheel speed| never pass the greater of their start and their limit.
//
//   Bicycle bicycle({.wheelbase_m = 1.9, ...});
//   bicycle.derivative(modes, y, dydt);            // the first kBicycleStates of both

#include <cstddef>
#include <span>

namespace stepwright::assemblies {

// Places of the state vector.
inline constexpr std::size_t kBicycleX = 0;        // m, of the reference point
inline constexpr std::size_t kBicycleY = 1;        // m
inline constexpr std::size_t kBicycleHeading = 2;  // rad, not wrapped
inline constexpr std::size_t kBicycleWheel = 3;    // m/s, speed of the drive wheels' rim
inline constexpr std::size_t kBicycleLock = 4;     // rad, steering; positive turns left when driving forward
inline constexpr std::size_t kBicycleTravel =
    5;  // m, way of the wheels' rim, whichever direction: the odometer
inline constexpr std::size_t kBicycleStates = 6;

struct BicycleFigures {
  double wheelbase_m = 0.0;
  double full_lock_rad = 0.0;
  double lock_time_constant_s = 0.0;
  double lock_rate_rad_s = 0.0;
  // Of the drive.
  double top_speed_m_s = 0.0;
  double time_constant_s = 0.0;
  double drive_force_n = 0.0;
  double brake_force_n = 0.0;
  double parking_brake_n = 0.0;
  double empty_mass_kg = 0.0;
  // How the ground is left.
  double drive_slip = 0.0;
  double understeer_s2_m2 = 0.0;
  double load_understeer_s2_m2_kg = 0.0;
};

// Inputs of the equations that are constant between two commands or faults.
struct BicycleModes {
  bool enabled = false;    // off: the spring brake holds
  double speed_m_s = 0.0;  // commanded, of the wheels' rim
  double lock_rad = 0.0;   // commanded
  double load_kg = 0.0;
  double drive_strength = 1.0;  // 1 = healthy
  double extra_slip = 0.0;      // on top of the figures' slip
  bool steering_stuck = false;

  friend bool operator==(const BicycleModes&, const BicycleModes&) = default;
};

// The same modes with another command; numbers that are not finite switch the drive off.
BicycleModes commanded(const BicycleModes& modes, bool enabled, double speed_m_s, double lock_rad);

class Bicycle {
 public:
  explicit Bicycle(const BicycleFigures& figures) : figures_(figures) {}

  // m/s of the reference point over ground.
  double ground_speed_m_s(const BicycleModes& modes, std::span<const double> y) const;
  // 1/m, of the way of the reference point; positive to the left when driving forward.
  double curvature_1_m(const BicycleModes& modes, std::span<const double> y) const;
  void derivative(const BicycleModes& modes, std::span<const double> y, std::span<double> dydt) const;

 private:
  double wheel_acceleration(const BicycleModes& modes, double wheel_m_s) const;

  BicycleFigures figures_;
};

}  // namespace stepwright::assemblies
