#include "plant_models/assemblies/fleet_floor.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "runtime/base/hash64.h"

namespace stepwright::assemblies {
namespace {

constexpr double kDegreesPerRad = 180.0 / std::numbers::pi;
constexpr double kWallFriction = 0.4;
constexpr double kVehicleFriction = 0.3;

std::int16_t counts(double value) {
  return static_cast<std::int16_t>(std::clamp(std::round(value), -32768.0, 32767.0));
}

double wrapped(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

// The chassis ends before the forks, which slide under pallets.
body2d::Rectangle chassis(const ForkliftBody& body) {
  return {{body.rear_m + kChassisFront_m, body.width_m}};
}

}  // namespace

FleetFloor::FleetFloor(const FleetParameters& parameters)
    : parameters_(parameters),
      ports_(make_ports(parameters)),
      description_(describe_fleet(parameters)),
      world_({.step_s = kFleetStepS}),
      overlap_monitor_(parameters) {}

result::Result<std::unique_ptr<FleetFloor>> FleetFloor::create(const FleetParameters& parameters) {
  if (auto valid = validate(parameters); !valid) return result::forward(valid);
  std::unique_ptr<FleetFloor> floor(new FleetFloor(parameters));
  if (auto added = floor->add_vehicles(); !added) return result::forward(added);
  floor->add_bodies();
  return floor;
}

result::Result<void> FleetFloor::add_vehicles() {
  for (const ForkliftPose& start : parameters_.starts) {
    auto forklift = Forklift::create(parameters_.forklift, start);
    if (!forklift) return result::forward(forklift);
    vehicles_.emplace_back();
    vehicles_.back().forklift = std::move(*forklift);
  }
  return {};
}

void FleetFloor::add_bodies() {
  for (const BlockParameters& wall : parameters_.walls)
    world_.add_paddle(wall.rectangle, wall.pose, kWallFriction);
  for (const BlockParameters& block : parameters_.blockages) {
    blockages_.push_back(world_.add_paddle(block.rectangle, block.pose, kWallFriction));
    world_.set_present(blockages_.back(), false);
  }
  const body2d::Rectangle shape = chassis(parameters_.forklift.body);
  for (Vehicle& vehicle : vehicles_) {
    vehicle.body = world_.add_box({shape, parameters_.forklift.drive.empty_mass_kg, kVehicleFriction},
                                  chassis_pose(vehicle.forklift->pose()));
  }
  for (const PalletParameters& pallet : parameters_.pallets) {
    const body2d::BoxBody box{{{kPalletLength_m, kPalletWidth_m}}, pallet.load_kg, kWallFriction};
    pallets_.push_back({world_.add_box(box, pallet.pose), pallet.load_kg, std::nullopt});
  }
  world_.warm_up(static_cast<int>(16 + 4 * vehicles_.size()));
}

body2d::Pose FleetFloor::chassis_pose(const ForkliftPose& pose) const {
  const double ahead_m = (kChassisFront_m - parameters_.forklift.body.rear_m) / 2.0;
  return {body2d::to_plane({{pose.x_m, pose.y_m}, pose.heading_rad}, {ahead_m, 0.0}), pose.heading_rad};
}

body2d::Pose FleetFloor::carried_pose(const Vehicle& vehicle, const ForkliftPose& pose) const {
  const body2d::Pose frame{{pose.x_m, pose.y_m}, pose.heading_rad};
  return {body2d::to_plane(frame, vehicle.pallet_grip.position),
          pose.heading_rad + vehicle.pallet_grip.angle};
}

double FleetFloor::time_s() const {
  return static_cast<double>(steps_) * kFleetStepS;
}

void FleetFloor::set_actuator(core::ActuatorId id, std::int16_t value) {
  assert(id.value < ports_.actuators.size());
  const auto target = ports_.actuator_targets[id.value];
  Vehicle& vehicle = vehicles_[target.index];
  switch (target.kind) {
    case FleetActuator::Enable:
      vehicle.enable = value != 0;
      return;
    case FleetActuator::Speed:
      vehicle.speed_mm_s = value;
      return;
    case FleetActuator::Lock:
      vehicle.lock_centidegrees = value;
      return;
    case FleetActuator::Lift:
      vehicle.lift = value != 0;
      return;
  }
}

core::PlantStatus FleetFloor::advance_to(std::chrono::nanoseconds time) {
  while (!failed_ && (steps_ + 1) * kFleetStep <= time) {
    failed_ = !step();
    ++steps_;
  }
  if (failed_) return core::PlantStatus::Failed;
  now_ = std::max(now_, time);
  return core::PlantStatus::Good;
}

double FleetFloor::noise(std::size_t vehicle, FleetSensor kind) const {
  constexpr std::uint64_t kStreams = 16;  // of one vehicle
  const core::CounterRandom random(parameters_.seed, kStreams * vehicle + static_cast<std::uint64_t>(kind));
  return random.normal(static_cast<std::uint64_t>(steps_));
}

std::int16_t FleetFloor::counts_of(const Vehicle& vehicle, std::size_t index, FleetSensor kind) const {
  const FleetNoise& deviation = parameters_.noise;
  const ForkliftPose pose = vehicle.frozen.value_or(vehicle.forklift->pose());
  // What is frozen does not even flicker.
  const double flicker = vehicle.frozen ? 0.0 : noise(index, kind);
  const double drift_cm = vehicle.drift_cm_s * (time_s() - vehicle.drift_since_s);
  const auto state = vehicle.forklift->state();
  switch (kind) {
    case FleetSensor::X:
      return counts(100.0 * (pose.x_m + deviation.position_m * flicker) + drift_cm);
    case FleetSensor::Y:
      return counts(100.0 * (pose.y_m + deviation.position_m * flicker));
    case FleetSensor::Heading:
      return counts(100.0 * kDegreesPerRad * wrapped(pose.heading_rad + deviation.heading_rad * flicker));
    case FleetSensor::Speed:
      return counts(1e3 * (state[kForkliftWheel] + deviation.speed_m_s * noise(index, kind)));
    default:
      return counts(100.0 * kDegreesPerRad * state[kForkliftLock]);
  }
}

std::int16_t FleetFloor::sensor(core::SensorId id) const {
  assert(id.value < ports_.sensors.size());
  const auto target = ports_.sensor_targets[id.value];
  if (target.kind == FleetSensor::EmergencyStop) return emergency_stop_ ? 0 : 1;
  const Vehicle& vehicle = vehicles_[target.index];
  if (vehicle.dead) return 0;
  switch (target.kind) {
    case FleetSensor::Lifted:
      return vehicle.lift_travel >= 1.0 ? 1 : 0;
    case FleetSensor::Lowered:
      return vehicle.lift_travel <= 0.0 ? 1 : 0;
    case FleetSensor::Loaded:
      return vehicle.pallet ? 1 : 0;
    case FleetSensor::Bumper:
      return vehicle.tripped ? 1 : 0;
    default:
      return counts_of(vehicle, target.index, target.kind);
  }
}

double FleetFloor::truth(core::TruthId id) const {
  assert(id.value < ports_.truths.size());
  const auto target = ports_.truth_targets[id.value];
  const std::size_t i = target.index;
  switch (target.kind) {
    case FleetTruth::X:
      return vehicles_[i].forklift->pose().x_m;
    case FleetTruth::Y:
      return vehicles_[i].forklift->pose().y_m;
    case FleetTruth::Heading:
      return vehicles_[i].forklift->pose().heading_rad;
    case FleetTruth::Speed:
      return vehicles_[i].forklift->speed_m_s();
    case FleetTruth::Lock:
      return vehicles_[i].forklift->state()[kForkliftLock];
    case FleetTruth::LoadedWith:
      return vehicles_[i].pallet ? static_cast<double>(*vehicles_[i].pallet + 1) : 0.0;
    case FleetTruth::PalletX:
      return world_.pose(pallets_[i].body).position.x;
    case FleetTruth::PalletY:
      return world_.pose(pallets_[i].body).position.y;
    case FleetTruth::PalletAngle:
      return world_.pose(pallets_[i].body).angle;
    case FleetTruth::PalletState:
      return pallets_[i].carrier ? 2.0 : 1.0;
    case FleetTruth::Blocked:
      return world_.present(blockages_[i]) ? 1.0 : 0.0;
    case FleetTruth::Contacts:
      return contacts_;
    case FleetTruth::GreatestForce:
      return greatest_force_n_;
    case FleetTruth::Overlaps:
      return static_cast<double>(overlap_monitor_.overlaps());
    case FleetTruth::ObstacleOverlaps:
      return static_cast<double>(overlap_monitor_.obstacle_overlaps());
    case FleetTruth::SmallestGap:
      return overlap_monitor_.smallest_gap_m();
  }
  return 0.0;
}

std::uint64_t FleetFloor::state_hash() const {
  std::uint64_t hash = world_.hash();
  for (const Vehicle& vehicle : vehicles_) {
    for (const double number : vehicle.forklift->state()) {
      hash = base::hash_mix(hash, std::bit_cast<std::uint64_t>(number));
    }
    hash = base::hash_mix(hash, std::bit_cast<std::uint64_t>(vehicle.lift_travel));
    hash = base::hash_mix(hash, vehicle.pallet ? *vehicle.pallet + 1 : 0);
  }
  return hash;
}

}  // namespace stepwright::assemblies
