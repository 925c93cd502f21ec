#pragma once

// Equations under CVODE whose modes change now and then: the solver starts anew only where they have. The
// state depends on the instants of changes only, bit for bit, however finely advance_to() slices the time.
//
// Thread rule: one thread at a time. Nothing is allocated after create(). The system must outlive it and must
// not move.
//
//   auto motion = SwitchedMotion::create(equations, y);
//   equations.modes = changed;
//   motion->note_change();
//   if (!motion->advance_to(0.01, y)) ...

#include <span>
#include <utility>

#include "plant_models/ode/cvode_solver.h"
#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

class SwitchedMotion {
 public:
  // From `y0` at 0 s. Fails with C0331.
  [[nodiscard]] static result::Result<SwitchedMotion> create(const ode::OdeSystem& system,
                                                             std::span<const double> y0);

  // With other settings than those of vehicles.
  [[nodiscard]] static result::Result<SwitchedMotion> create(const ode::OdeSystem& system,
                                                             std::span<const double> y0,
                                                             const ode::CvodeSettings& settings);

  // Modes or state are others from now on.
  void note_change() { changed_ = true; }

  // Runs `y` to `t_s`; a time that has passed changes nothing. False if the solver has given up, for good.
  bool advance_to(double t_s, std::span<double> y);

 private:
  explicit SwitchedMotion(ode::CvodeSolver solver) : solver_(std::move(solver)) {}

  ode::CvodeSolver solver_;
  double now_s_ = 0.0;
  bool changed_ = false;  // at now_s_: restart before the next step
  bool failed_ = false;
};

}  // namespace stepwright::assemblies
