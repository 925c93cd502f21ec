#include "plant_models/assemblies/forklift.h"

#include <utility>

namespace stepwright::assemblies {

Forklift::Forklift(const ForkliftParameters& parameters, const ForkliftPose& start) : equations_(parameters) {
  y_[kForkliftX] = start.x_m;
  y_[kForkliftY] = start.y_m;
  y_[kForkliftHeading] = start.heading_rad;
}

result::Result<std::unique_ptr<Forklift>> Forklift::create(const ForkliftParameters& parameters,
                                                           const ForkliftPose& start) {
  if (auto valid = validate(parameters); !valid) return result::forward(valid);
  std::unique_ptr<Forklift> forklift(new Forklift(parameters, start));
  auto motion = SwitchedMotion::create(forklift->equations_, forklift->y_);
  if (!motion) return result::forward(motion);
  forklift->motion_ = std::move(*motion);
  return forklift;
}

void Forklift::command(const ForkliftCommand& command) {
  set_modes(commanded(equations_.modes, command.enabled, command.speed_m_s, command.lock_rad));
}

void Forklift::set_modes(const ForkliftModes& modes) {
  if (modes == equations_.modes) return;
  equations_.modes = modes;
  motion_->note_change();
}

void Forklift::stop_at(const ForkliftPose& pose) {
  y_[kForkliftX] = pose.x_m;
  y_[kForkliftY] = pose.y_m;
  y_[kForkliftHeading] = pose.heading_rad;
  y_[kForkliftWheel] = 0.0;
  motion_->note_change();
}

}  // namespace stepwright::assemblies
