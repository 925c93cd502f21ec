#include "plant_models/assemblies/tugger_train.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace stepwright::assemblies {

TuggerTrain::TuggerTrain(const TuggerParameters& parameters)
    : links_(parameters.links),
      trailer_kg_(parameters.drive.trailer_kg),
      equations_(parameters),
      states_(equations_.state_size()) {
  y_[kBicycleX] = parameters.start.position.x;
  y_[kBicycleY] = parameters.start.position.y;
  y_[kBicycleHeading] = parameters.start.angle;
}

result::Result<std::unique_ptr<TuggerTrain>> TuggerTrain::create(const TuggerParameters& parameters) {
  if (auto valid = validate(parameters); !valid) return result::forward(valid);
  std::unique_ptr<TuggerTrain> train(new TuggerTrain(parameters));
  auto motion = SwitchedMotion::create(train->equations_, {train->y_.data(), train->states_});
  if (!motion) return result::forward(motion);
  train->motion_ = std::move(*motion);
  train->couple(parameters.trailers);
  return train;
}

void TuggerTrain::command(bool enabled, double speed_m_s, double lock_rad) {
  set_modes(commanded(equations_.modes, enabled, speed_m_s, lock_rad));
}

void TuggerTrain::set_modes(const BicycleModes& modes) {
  BicycleModes changed = modes;
  changed.load_kg = trailer_kg_ * static_cast<double>(coupled());
  if (changed == equations_.modes) return;
  equations_.modes = changed;
  motion_->note_change();
}

bool TuggerTrain::advance_to(double t_s) {
  if (!motion_->advance_to(t_s, {y_.data(), states_})) return false;
  place_boxes();
  return true;
}

void TuggerTrain::couple(std::size_t trailers) {
  trailers = std::min(trailers, states_ - kTuggerTrailer);
  for (std::size_t link = coupled() + 1; link <= trailers; ++link)
    y_[kTuggerTrailer + link - 1] = heading_rad(link - 1);
  equations_.coupled = trailers;
  motion_->note_change();
  set_modes(equations_.modes);
  place_boxes();
}

double TuggerTrain::hitch_rad(std::size_t trailer) const {
  return std::remainder(heading_rad(trailer - 1) - heading_rad(trailer), 2.0 * std::numbers::pi);
}

void TuggerTrain::stop_at(std::span<const double> state) {
  std::copy_n(state.begin(), std::min(state.size(), states_), y_.begin());
  y_[kBicycleWheel] = 0.0;
  motion_->note_change();
  place_boxes();
}

void TuggerTrain::place_boxes() {
  body2d::Vec2 middle{y_[kBicycleX], y_[kBicycleY]};
  for (std::size_t link = 0; link <= coupled(); ++link) {
    const body2d::Vec2 ahead{std::cos(heading_rad(link)), std::sin(heading_rad(link))};
    if (link > 0) middle = middle - links_.spacing_m * ahead;
    boxes_[link] = {middle, ahead, 0.5 * links_.length_m, 0.5 * links_.width_m};
  }
}

}  // namespace stepwright::assemblies
