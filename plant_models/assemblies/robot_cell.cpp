#include "plant_models/assemblies/robot_cell.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "plant_models/core/counter_random.h"
#include "runtime/base/hash64.h"

namespace stepwright::assemblies {
namespace {

constexpr double kCountsPerRad = 1e4;
constexpr double kCountsPer_m = 1e4;
constexpr double kPressing_n = 1.0;  // that a hand feels

std::int16_t cell_counts(double value) {
  return static_cast<std::int16_t>(std::clamp(std::round(value), -32768.0, 32767.0));
}

}  // namespace

RobotCell::RobotCell(const RobotCellParameters& parameters)
    : parameters_(parameters),
      ports_(make_ports(parameters)),
      description_(describe_robot_cell(parameters)),
      objects_(parameters),
      camera_(parameters),
      judge_(parameters),
      arms_(parameters.arms.size()),
      joint_faults_(parameters.arms.size() * kArmJoints) {}

result::Result<std::unique_ptr<RobotCell>> RobotCell::create(const RobotCellParameters& parameters) {
  auto drives = RobotDrives::create(parameters);
  if (!drives) return result::forward(drives);
  std::unique_ptr<RobotCell> cell(new RobotCell(parameters));
  cell->drives_ = std::move(*drives);
  cell->before_.assign(cell->drives_->state().begin(), cell->drives_->state().end());
  cell->looked_ = cell->before_;
  for (std::size_t arm = 0; arm < cell->arms_.size(); ++arm) {
    Arm& here = cell->arms_[arm];
    for (std::size_t k = 0; k < kArmJoints; ++k)
      here.wanted[k] = cell_counts(kCountsPerRad * parameters.arms[arm].start_rad[k]);
    here.opening_before_m = parameters.arms[arm].most_opening_m;
    here.opening = cell_counts(kCountsPer_m * here.opening_before_m);
    for (std::size_t k = 0; k < here.poses.size(); ++k) cell->pose_arm(arm);
  }
  cell->look();
  return cell;
}

void RobotCell::set_actuator(core::ActuatorId id, std::int16_t value) {
  assert(id.value < ports_.actuators.size());
  const auto [kind, index] = ports_.actuator_targets[id.value];
  switch (kind) {
    case CellActuator::Enable:
      arms_[index].enable = value != 0;
      return;
    case CellActuator::Joint:
      arms_[index / kArmJoints].wanted[index % kArmJoints] = value;
      return;
    case CellActuator::Grip:
      arms_[index].opening = value;
      return;
    case CellActuator::Trigger:
      if (value != 0 && !triggered_)
        camera_.trigger(static_cast<double>(steps_) * kRobotCellStepS, objects_.all(), blocked_);
      triggered_ = value != 0;
      return;
  }
}

core::PlantStatus RobotCell::advance_to(std::chrono::nanoseconds time) {
  while (!failed_ && (steps_ + 1) * kRobotCellStep <= time) {
    failed_ = !step();
    ++steps_;
  }
  if (failed_) return core::PlantStatus::Failed;
  now_ = std::max(now_, time);
  return core::PlantStatus::Good;
}

std::int16_t RobotCell::seen(CellSensor kind, std::size_t slot) const {
  const auto report = camera_.report();
  if (slot >= report.size()) return 0;
  const Sighting& there = report[slot];
  switch (kind) {
    case CellSensor::SeenKind:
      return static_cast<std::int16_t>(there.kind);
    case CellSensor::SeenX:
      return cell_counts(kCountsPer_m * there.pose.place.x);
    case CellSensor::SeenY:
      return cell_counts(kCountsPer_m * there.pose.place.y);
    case CellSensor::SeenZ:
      return cell_counts(kCountsPer_m * there.pose.place.z);
    default:
      return cell_counts(kCountsPerRad * std::remainder(there.pose.yaw_rad, 2.0 * std::numbers::pi));
  }
}

std::int16_t RobotCell::counts_of(CellSensor kind, std::size_t index) const {
  switch (kind) {
    case CellSensor::Joint: {
      const EncoderFigures& encoder = parameters_.encoder;
      const double flicker =
          core::CounterRandom(parameters_.seed, index).normal(static_cast<std::uint64_t>(steps_));
      const double shown = drives_->angle_rad(index) + encoder.noise_rad * flicker;
      return cell_counts(kCountsPerRad * encoder.resolution_rad * std::round(shown / encoder.resolution_rad));
    }
    case CellSensor::Width:
      return cell_counts(kCountsPer_m * drives_->opening_m(index));
    case CellSensor::Ready:
      return arms_[index].enable && !arms_[index].tripped && !emergency_stop_ ? 1 : 0;
    case CellSensor::Tripped:
      return arms_[index].tripped ? 1 : 0;
    case CellSensor::Grasping:
      return arms_[index].grasp && grip_force_n(index) > kPressing_n ? 1 : 0;
    case CellSensor::EmergencyStop:
      return emergency_stop_ ? 0 : 1;
    case CellSensor::Pictures:
      return static_cast<std::int16_t>(camera_.pictures() % 32768);
    case CellSensor::SeenCount:
      return static_cast<std::int16_t>(camera_.report().size());
    default:
      return seen(kind, index);
  }
}

std::int16_t RobotCell::sensor(core::SensorId id) const {
  assert(id.value < ports_.sensors.size());
  const auto [kind, index] = ports_.sensor_targets[id.value];
  return counts_of(kind, index);
}

double RobotCell::truth_of_object(CellTruth kind, std::size_t object) const {
  const CellObject& there = objects_[object];
  switch (kind) {
    case CellTruth::ObjectX:
      return there.pose.place.x;
    case CellTruth::ObjectY:
      return there.pose.place.y;
    case CellTruth::ObjectZ:
      return there.pose.place.z;
    case CellTruth::ObjectYaw:
      return there.pose.yaw_rad;
    case CellTruth::ObjectState:
      return static_cast<double>(there.state);
    default:
      return there.support;
  }
}

double RobotCell::truth(core::TruthId id) const {
  assert(id.value < ports_.truths.size());
  const auto [kind, index] = ports_.truth_targets[id.value];
  switch (kind) {
    case CellTruth::Joint:
      return drives_->angle_rad(index);
    case CellTruth::Width:
      return drives_->opening_m(index);
    case CellTruth::Held:
      return arms_[index].grasp ? static_cast<double>(arms_[index].grasp->object + 1) : 0.0;
    case CellTruth::Blocked:
      return blocked_[index] ? 1.0 : 0.0;
    case CellTruth::Incidents:
      return static_cast<double>(judge_.count(static_cast<IncidentKind>(index)));
    case CellTruth::SmallestGap:
      return judge_.smallest_gap_m();
    case CellTruth::WorstTilt:
      return worst_tilt_rad_;
    default:
      return truth_of_object(kind, index);
  }
}

std::uint64_t RobotCell::state_hash() const {
  std::uint64_t hash =
      base::hash_mix(static_cast<std::uint64_t>(steps_), static_cast<std::uint64_t>(camera_.pictures()));
  const auto add = [&hash](double number) {
    hash = base::hash_mix(hash, std::bit_cast<std::uint64_t>(number));
  };
  for (const double number : drives_->state()) add(number);
  for (std::uint32_t k = 0; k < ports_.truths.size(); ++k) add(truth(core::TruthId(k)));
  for (std::uint32_t k = 0; k < ports_.sensors.size(); ++k) add(sensor(core::SensorId(k)));
  return hash;
}

}  // namespace stepwright::assemblies
