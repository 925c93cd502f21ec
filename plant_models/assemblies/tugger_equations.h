#pragma once

// The differential equations of a tractor with trailers, as plant_models/doc/tugger.md derives them: the
// tractor is a kinematic bicycle (bicycle.h) whose load are its trailers, and each trailer is pulled by its
// hitch (S. M. LaValle, Planning Algorithms, 2006, section 13.1.2.4). Pure functions of parameters, modes and
// state.
//
// Invariant: headings of trailers that are not coupled do not change.

#include <cstddef>
#include <span>

#include "plant_models/assemblies/bicycle.h"
#include "plant_models/assemblies/tugger_parameters.h"
#include "plant_models/ode/ode_system.h"

namespace stepwright::assemblies {

// Places of the state vector: those of the bicycle, then the headings of trailers, rad, not wrapped.
inline constexpr std::size_t kTuggerTrailer = kBicycleStates;
inline constexpr std::size_t kMostTuggerStates = kTuggerTrailer + kMostTuggerTrailers;

class TuggerEquations final : public ode::OdeSystem {
 public:
  explicit TuggerEquations(const TuggerParameters& parameters);

  BicycleModes modes;
  std::size_t coupled = 0;  // trailers; at most those of the state

  std::size_t state_size() const override { return kTuggerTrailer + trailers_; }
  std::size_t root_count() const override { return 0; }
  void derivative(double t, std::span<const double> y, std::span<double> dydt) const override;
  void roots(double, std::span<const double>, std::span<double>) const override {}

  // As Bicycle has them, of the tractor.
  double ground_speed_m_s(std::span<const double> y) const { return bicycle_.ground_speed_m_s(modes, y); }
  double curvature_1_m(std::span<const double> y) const { return bicycle_.curvature_1_m(modes, y); }

 private:
  Bicycle bicycle_;
  std::size_t trailers_;  // of the state
  double hitch_m_;
  double hitch_slip_s2_m2_;
};

}  // namespace stepwright::assemblies
