#pragma once

// The differential equations of a forklift, as plant_models/doc/forklift.md derives them: a kinematic bicycle
// that is steered at the rear, with a force-limited drive, a rate-limited steering and slip. Pure functions
// of parameters, modes and state, SI units. Between two changes of the modes the equations are smooth except
// for the kinks of the limits, which the error control of the solver handles.
//
// Invariant: |steering angle| and |wheel speed| never pass the greater of their start and their limit.

#include <cstddef>
#include <span>

#include "plant_models/assemblies/forklift_parameters.h"
#include "plant_models/ode/ode_system.h"

namespace stepwright::assemblies {

// Places of the state vector.
inline constexpr std::size_t kForkliftX = 0;        // m, of the reference point
inline constexpr std::size_t kForkliftY = 1;        // m
inline constexpr std::size_t kForkliftHeading = 2;  // rad, not wrapped
inline constexpr std::size_t kForkliftWheel = 3;    // m/s, speed of the drive wheels' rim
inline constexpr std::size_t kForkliftLock = 4;     // rad, steering; positive turns left when driving forward
inline constexpr std::size_t kForkliftTravel =
    5;  // m, way of the wheels' rim, whichever direction: the odometer
inline constexpr std::size_t kForkliftStates = 6;

// Inputs of the equations that are constant between two commands or faults.
struct ForkliftModes {
  bool enabled = false;    // off: the spring brake holds
  double speed_m_s = 0.0;  // commanded, of the wheels' rim
  double lock_rad = 0.0;   // commanded
  double load_kg = 0.0;
  double drive_strength = 1.0;  // 1 = healthy
  double extra_slip = 0.0;      // on top of the parameters' slip
  bool steering_stuck = false;

  friend bool operator==(const ForkliftModes&, const ForkliftModes&) = default;
};

class ForkliftEquations final : public ode::OdeSystem {
 public:
  explicit ForkliftEquations(const ForkliftParameters& parameters);

  ForkliftModes modes;

  std::size_t state_size() const override { return kForkliftStates; }
  std::size_t root_count() const override { return 0; }
  void derivative(double t, std::span<const double> y, std::span<double> dydt) const override;
  void roots(double, std::span<const double>, std::span<double>) const override {}

  // m/s of the reference point over ground.
  double ground_speed_m_s(std::span<const double> y) const;
  // 1/m, of the way of the reference point; positive to the left when driving forward.
  double curvature_1_m(std::span<const double> y) const;

 private:
  double wheel_acceleration(double wheel_m_s) const;

  ForkliftParameters parameters_;
  double full_lock_rad_;
};

}  // namespace stepwright::assemblies
