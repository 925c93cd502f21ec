#include "plant_models/assemblies/switched_motion.h"

namespace stepwright::assemblies {
namespace {

// Below these errors per step nothing that a sensor or a report shows changes.
ode::CvodeSettings motion_settings(std::size_t states) {
  ode::CvodeSettings settings;
  settings.absolute_tolerance.assign(states, 1e-7);
  settings.first_step_s = 5e-3;
  return settings;
}

}  // namespace

result::Result<SwitchedMotion> SwitchedMotion::create(const ode::OdeSystem& system,
                                                      std::span<const double> y0) {
  return create(system, y0, motion_settings(y0.size()));
}

result::Result<SwitchedMotion> SwitchedMotion::create(const ode::OdeSystem& system,
                                                      std::span<const double> y0,
                                                      const ode::CvodeSettings& settings) {
  auto solver = ode::CvodeSolver::create(system, y0, 0.0, settings);
  if (!solver) return result::forward(solver);
  return SwitchedMotion(std::move(*solver));
}

bool SwitchedMotion::advance_to(double t_s, std::span<double> y) {
  if (failed_) return false;
  if (!(t_s > now_s_)) return true;
  if (changed_) {
    changed_ = false;
    if (!solver_.restart(now_s_, y)) failed_ = true;
  }
  while (!failed_ && solver_.time() < t_s) failed_ = solver_.step() == ode::StepOutcome::Failed;
  failed_ = failed_ || !solver_.state_at(t_s, y);
  if (!failed_) now_s_ = t_s;
  return !failed_;
}

}  // namespace stepwright::assemblies
