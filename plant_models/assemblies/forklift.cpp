#include "plant_models/assemblies/forklift.h"

#include <cmath>

namespace stepwright::assemblies {
namespace {

// Below these errors per step nothing that a sensor or a report shows changes.
ode::CvodeSettings solver_settings() {
  ode::CvodeSettings settings;
  settings.absolute_tolerance.assign(kForkliftStates, 1e-7);
  settings.first_step_s = 5e-3;
  return settings;
}

}  // namespace

Forklift::Forklift(const ForkliftParameters& parameters, const ForkliftPose& start) : equations_(parameters) {
  y_[kForkliftX] = start.x_m;
  y_[kForkliftY] = start.y_m;
  y_[kForkliftHeading] = start.heading_rad;
}

result::Result<std::unique_ptr<Forklift>> Forklift::create(const ForkliftParameters& parameters,
                                                           const ForkliftPose& start) {
  if (auto valid = validate(parameters); !valid) return result::forward(valid);
  std::unique_ptr<Forklift> forklift(new Forklift(parameters, start));
  auto solver = ode::CvodeSolver::create(forklift->equations_, forklift->y_, 0.0, solver_settings());
  if (!solver) return result::forward(solver);
  forklift->solver_ = std::make_unique<ode::CvodeSolver>(std::move(*solver));
  return forklift;
}

void Forklift::command(const ForkliftCommand& command) {
  ForkliftModes modes = equations_.modes;
  modes.enabled = command.enabled && std::isfinite(command.speed_m_s) && std::isfinite(command.lock_rad);
  modes.speed_m_s = modes.enabled ? command.speed_m_s : 0.0;
  modes.lock_rad = modes.enabled ? command.lock_rad : modes.lock_rad;
  set_modes(modes);
}

void Forklift::set_modes(const ForkliftModes& modes) {
  if (modes == equations_.modes) return;
  equations_.modes = modes;
  changed_ = true;
}

bool Forklift::advance_to(double t_s) {
  if (failed_) return false;
  if (!(t_s > now_s_)) return true;
  if (changed_) {
    changed_ = false;
    if (!solver_->restart(now_s_, y_)) failed_ = true;
  }
  while (!failed_ && solver_->time() < t_s) failed_ = solver_->step() == ode::StepOutcome::Failed;
  failed_ = failed_ || !solver_->state_at(t_s, y_);
  if (!failed_) now_s_ = t_s;
  return !failed_;
}

void Forklift::stop_at(const ForkliftPose& pose) {
  y_[kForkliftX] = pose.x_m;
  y_[kForkliftY] = pose.y_m;
  y_[kForkliftHeading] = pose.heading_rad;
  y_[kForkliftWheel] = 0.0;
  changed_ = true;
}

}  // namespace stepwright::assemblies
