#include "plant_models/assemblies/tugger.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "plant_models/core/counter_random.h"
#include "runtime/base/hash64.h"

namespace stepwright::assemblies {
namespace {

constexpr double kCentidegreesPerRad = 18'000.0 / std::numbers::pi;
constexpr std::uint64_t kHitchStreams = 16;  // of noise, behind those of the other sensors

std::int16_t whole_counts(double value) {
  return static_cast<std::int16_t>(std::clamp(std::round(value), -32768.0, 32767.0));
}

double within_a_turn(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

// Whether the links are elsewhere; how fast they are does not count.
bool is_elsewhere(std::span<const double> before, std::span<const double> now) {
  return before[kBicycleX] != now[kBicycleX] || before[kBicycleY] != now[kBicycleY] ||
         before[kBicycleHeading] != now[kBicycleHeading] ||
         !std::ranges::equal(before.subspan(kTuggerTrailer), now.subspan(kTuggerTrailer));
}

}  // namespace

Tugger::Tugger(const TuggerParameters& parameters)
    : parameters_(parameters),
      ports_(make_ports(parameters)),
      description_(describe_tugger(parameters)),
      floor_(parameters) {}

result::Result<std::unique_ptr<Tugger>> Tugger::create(const TuggerParameters& parameters) {
  auto train = TuggerTrain::create(parameters);
  if (!train) return result::forward(train);
  std::unique_ptr<Tugger> tugger(new Tugger(parameters));
  tugger->train_ = std::move(*train);
  tugger->before_.resize(tugger->train_->state().size());
  return tugger;
}

void Tugger::set_actuator(core::ActuatorId id, std::int16_t value) {
  assert(id.value < ports_.actuators.size());
  switch (ports_.actuator_targets[id.value].kind) {
    case TuggerActuator::Enable:
      enable_ = value != 0;
      return;
    case TuggerActuator::Speed:
      speed_mm_s_ = value;
      return;
    case TuggerActuator::Lock:
      lock_centidegrees_ = value;
      return;
  }
}

core::PlantStatus Tugger::advance_to(std::chrono::nanoseconds time) {
  while (!failed_ && (steps_ + 1) * kTuggerStep <= time) {
    failed_ = !step();
    ++steps_;
  }
  if (failed_) return core::PlantStatus::Failed;
  now_ = std::max(now_, time);
  return core::PlantStatus::Good;
}

// The train goes where its equations lead. If something stands there it stays where the step began, at rest.
bool Tugger::step() {
  if (!enable_) tripped_ = false;
  const bool moves = enable_ && !tripped_ && !dead_ && !emergency_stop_;
  train_->command(moves, 1e-3 * speed_mm_s_, lock_centidegrees_ / kCentidegreesPerRad);
  std::copy_n(train_->state().begin(), before_.size(), before_.begin());
  if (!train_->advance_to(static_cast<double>(steps_ + 1) * kTuggerStepS)) return false;
  const bool elsewhere = is_elsewhere(before_, train_->state());
  if (!elsewhere && !changed_) return true;
  changed_ = false;
  if (!floor_.touches(train_->boxes())) {
    touching_ = false;
    floor_.note_gap(train_->boxes());
    return true;
  }
  if (!tripped_ && !touching_) ++contacts_;
  tripped_ = true;
  touching_ = true;
  floor_.note_contact();
  if (elsewhere) {
    train_->stop_at(before_);
    changed_ = true;
  }
  return true;
}

double Tugger::noise(std::uint64_t stream) const {
  return core::CounterRandom(parameters_.seed, stream).normal(static_cast<std::uint64_t>(steps_));
}

std::int16_t Tugger::counts_of(TuggerSensor kind, std::size_t index) const {
  const TuggerNoise& deviation = parameters_.noise;
  const body2d::Pose pose = frozen_.value_or(train_->tractor());
  const double flicker = noise(static_cast<std::uint64_t>(kind));
  const double shown = frozen_ ? 0.0 : flicker;  // what is frozen does not even flicker
  const auto state = train_->state();
  switch (kind) {
    case TuggerSensor::X:
      return whole_counts(100.0 * (pose.position.x + deviation.position_m * shown) +
                          drift_cm_s_ * (time_s() - drift_since_s_));
    case TuggerSensor::Y:
      return whole_counts(100.0 * (pose.position.y + deviation.position_m * shown));
    case TuggerSensor::Heading:
      return whole_counts(kCentidegreesPerRad * within_a_turn(pose.angle + deviation.heading_rad * shown));
    case TuggerSensor::Speed:
      return whole_counts(1e3 * (state[kBicycleWheel] + deviation.speed_m_s * flicker));
    case TuggerSensor::Lock:
      return whole_counts(kCentidegreesPerRad * state[kBicycleLock]);
    case TuggerSensor::Hitch:
      if (index > train_->coupled()) return 0;
      return whole_counts(kCentidegreesPerRad *
                          (train_->hitch_rad(index) + deviation.hitch_rad * noise(kHitchStreams + index)));
    default:
      return static_cast<std::int16_t>(train_->coupled());
  }
}

std::int16_t Tugger::sensor(core::SensorId id) const {
  assert(id.value < ports_.sensors.size());
  const auto target = ports_.sensor_targets[id.value];
  // Not the tractor's own.
  if (target.kind == TuggerSensor::EmergencyStop) return emergency_stop_ ? 0 : 1;
  if (target.kind == TuggerSensor::AtPlace)
    return floor_.in_place(target.index, train_->tractor().position) ? 1 : 0;
  if (dead_) return 0;
  if (target.kind == TuggerSensor::Bumper) return tripped_ ? 1 : 0;
  if (target.kind == TuggerSensor::WayFree) return floor_.way_is_free(train_->boxes().front()) ? 1 : 0;
  return counts_of(target.kind, target.index);
}

double Tugger::truth_of_trailer(TuggerTruth kind, std::size_t trailer) const {
  const bool coupled = trailer <= train_->coupled();
  const auto& left = floor_.left(trailer);
  if (kind == TuggerTruth::LinkState) return coupled ? 1.0 : left ? 2.0 : 0.0;
  if (kind == TuggerTruth::Heading) return train_->heading_rad(trailer);
  if (!coupled && !left) return 0.0;
  const body2d::Vec2 middle = coupled ? train_->boxes()[trailer].middle : left->middle;
  return kind == TuggerTruth::X ? middle.x : middle.y;
}

double Tugger::truth(core::TruthId id) const {
  assert(id.value < ports_.truths.size());
  const auto target = ports_.truth_targets[id.value];
  switch (target.kind) {
    case TuggerTruth::X:
      return target.index > 0 ? truth_of_trailer(target.kind, target.index) : train_->tractor().position.x;
    case TuggerTruth::Y:
      return target.index > 0 ? truth_of_trailer(target.kind, target.index) : train_->tractor().position.y;
    case TuggerTruth::Heading:
      return target.index > 0 ? truth_of_trailer(target.kind, target.index) : train_->tractor().angle;
    case TuggerTruth::LinkState:
      return truth_of_trailer(target.kind, target.index);
    case TuggerTruth::Speed:
      return train_->speed_m_s();
    case TuggerTruth::Lock:
      return train_->state()[kBicycleLock];
    case TuggerTruth::Trailers:
      return static_cast<double>(train_->coupled());
    case TuggerTruth::Blocked:
      return floor_.blocked(target.index) ? 1.0 : 0.0;
    case TuggerTruth::Contacts:
      return contacts_;
    case TuggerTruth::SmallestGap:
      return floor_.smallest_gap_m();
  }
  return 0.0;
}

std::uint64_t Tugger::state_hash() const {
  std::uint64_t hash = base::hash_mix(train_->coupled(), static_cast<std::uint64_t>(contacts_));
  const auto add = [&hash](double number) {
    hash = base::hash_mix(hash, std::bit_cast<std::uint64_t>(number));
  };
  for (const double number : train_->state()) add(number);
  for (std::size_t k = 1; k <= most_trailers(parameters_); ++k) {
    add(truth_of_trailer(TuggerTruth::X, k));
    add(truth_of_trailer(TuggerTruth::Y, k));
  }
  add(floor_.smallest_gap_m());
  return hash;
}

}  // namespace stepwright::assemblies
