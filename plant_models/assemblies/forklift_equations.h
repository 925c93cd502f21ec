#pragma once

// The differential equations of a forklift, as plant_models/doc/forklift.md derives them: those of bicycle.h
// with the figures of a vehicle that is steered at the rear. Pure functions of parameters, modes and state.

#include <cstddef>
#include <span>

#include "plant_models/assemblies/bicycle.h"
#include "plant_models/assemblies/forklift_parameters.h"
#include "plant_models/ode/ode_system.h"

namespace stepwright::assemblies {

// Places of the state vector.
inline constexpr std::size_t kForkliftX = kBicycleX;
inline constexpr std::size_t kForkliftY = kBicycleY;
inline constexpr std::size_t kForkliftHeading = kBicycleHeading;
inline constexpr std::size_t kForkliftWheel = kBicycleWheel;
inline constexpr std::size_t kForkliftLock = kBicycleLock;
inline constexpr std::size_t kForkliftTravel = kBicycleTravel;
inline constexpr std::size_t kForkliftStates = kBicycleStates;

using ForkliftModes = BicycleModes;

class ForkliftEquations final : public ode::OdeSystem {
 public:
  explicit ForkliftEquations(const ForkliftParameters& parameters);

  ForkliftModes modes;

  std::size_t state_size() const override { return kForkliftStates; }
  std::size_t root_count() const override { return 0; }
  void derivative(double, std::span<const double> y, std::span<double> dydt) const override {
    bicycle_.derivative(modes, y, dydt);
  }
  void roots(double, std::span<const double>, std::span<double>) const override {}

  // As Bicycle has them.
  double ground_speed_m_s(std::span<const double> y) const { return bicycle_.ground_speed_m_s(modes, y); }
  double curvature_1_m(std::span<const double> y) const { return bicycle_.curvature_1_m(modes, y); }

 private:
  Bicycle bicycle_;
};

}  // namespace stepwright::assemblies
