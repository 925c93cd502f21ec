#include "plant_models/assemblies/robot_cell_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace stepwright::assemblies {
namespace {

// Of the numbers of one object or ghost in a picture.
constexpr std::uint64_t kPerSighting = 8;
constexpr std::uint64_t kBlockageStreams = 48;  // behind those of objects
constexpr std::uint64_t kGhostStreams = 512;
constexpr std::uint64_t kOrderStream = 900;

double unit(const core::CounterRandom& random, std::uint64_t counter) {
  return 0.5 * (1.0 + random.symmetric(counter));
}

}  // namespace

CellCamera::CellCamera(const RobotCellParameters& parameters)
    : figures_(parameters.camera), seed_(parameters.seed) {
  for (const ObjectFigures& object : parameters.objects) kinds_.push_back(object.kind);
  for (const FixedBody& body : parameters.blockages) {
    Sighting there{ObjectKind::Obstacle, {}};
    there.pose.place = body.frame.place - Vec3{0.0, 0.0, body.solid.half_m.z + body.solid.round_m};
    there.pose.yaw_rad = std::atan2(body.frame.turn.m[3], body.frame.turn.m[0]);
    blockages_.push_back(there);
  }
  picture_.resize(camera_slots(parameters));
  report_.resize(picture_.size());
}

Sighting CellCamera::seen(const Sighting& truth, std::uint64_t stream) const {
  const auto counter = static_cast<std::uint64_t>(pictures_);
  const auto off = [&](std::uint64_t k) { return random(kPerSighting * stream + k).normal(counter); };
  Sighting found = truth;
  found.pose.place =
      truth.pose.place + Vec3{faults.offset_x_m + figures_.position_m * off(1),
                              faults.offset_y_m + figures_.position_m * off(2), figures_.position_m * off(3)};
  found.pose.yaw_rad = std::remainder(truth.pose.yaw_rad + figures_.yaw_rad * off(4), 2.0 * std::numbers::pi);
  return found;
}

Sighting CellCamera::ghost(std::uint64_t stream) const {
  const auto counter = static_cast<std::uint64_t>(pictures_);
  const auto part = [&](std::uint64_t k) {
    return unit(random(kGhostStreams + kPerSighting * stream + k), counter);
  };
  Sighting nothing;
  nothing.kind = static_cast<ObjectKind>(1 + static_cast<int>(3.999 * part(1)));
  nothing.pose.place = {figures_.view_low_x_m + part(2) * (figures_.view_high_x_m - figures_.view_low_x_m),
                        figures_.view_low_y_m + part(3) * (figures_.view_high_y_m - figures_.view_low_y_m),
                        0.7 + 0.1 * part(4)};
  nothing.pose.yaw_rad = std::numbers::pi * (2.0 * part(5) - 1.0);
  return nothing;
}

// Fisher and Yates: the place in a report says nothing of the object.
void CellCamera::shuffle() {
  const auto counter = static_cast<std::uint64_t>(pictures_);
  for (std::size_t k = taken_; k > 1; --k) {
    const double part = unit(random(kOrderStream + k), counter);
    std::swap(picture_[k - 1], picture_[static_cast<std::size_t>(part * static_cast<double>(k)) % k]);
  }
}

void CellCamera::trigger(double now_s, std::span<const CellObject> objects, std::span<const bool> blocked) {
  if (busy() || faults.dead) return;
  const auto counter = static_cast<std::uint64_t>(pictures_);
  taken_ = 0;
  const double loss = 1.0 - (1.0 - figures_.loss) * (1.0 - faults.loss);
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const bool lost = unit(random(kPerSighting * k), counter) < loss;
    if (lost || objects[k].state == ObjectState::Falls || taken_ == picture_.size()) continue;
    picture_[taken_++] = seen({kinds_[k], objects[k].pose}, k);
  }
  for (std::size_t k = 0; k < std::min(blocked.size(), blockages_.size()); ++k) {
    const std::uint64_t stream = kBlockageStreams + k;
    const bool lost = unit(random(kPerSighting * stream), counter) < loss;
    if (blocked[k] && !lost && taken_ < picture_.size()) picture_[taken_++] = seen(blockages_[k], stream);
  }
  std::size_t ghosts = faults.ghosts;
  if (unit(random(kGhostStreams), counter) < figures_.ghosts) ++ghosts;
  for (std::size_t k = 0; k < ghosts && taken_ < picture_.size(); ++k) picture_[taken_++] = ghost(k);
  shuffle();
  due_s_ = now_s + figures_.delay_s;
}

void CellCamera::step(double now_s) {
  if (!busy() || now_s < due_s_) return;
  due_s_ = -1.0;
  if (faults.dead) return;
  std::swap(picture_, report_);
  reported_ = taken_;
  ++pictures_;
}

}  // namespace stepwright::assemblies
