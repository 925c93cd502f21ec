#include <string>

#include "plant_models/assemblies/fleet_floor.h"
#include "runtime/ground/result/counted.h"

namespace stepwright::assemblies {
namespace {

constexpr std::string_view kFleetPlant = "the fleet";

}  // namespace

std::string FleetFloor::violation() const {
  if (const auto met = overlap_monitor_.overlaps(); met > 0)
    return "vehicles overlapped in " + result::counted(met, "step", "steps");
  if (const auto met = overlap_monitor_.obstacle_overlaps(); met > 0)
    return "a vehicle overlapped what stands there in " + result::counted(met, "step", "steps");
  return {};
}

result::Result<void> FleetFloor::inject_fault(std::string_view name, double value) {
  auto fault = find_fault(kFleetPlant, ports_.faults, name);
  if (!fault) return result::forward(fault);
  if (auto good = check_fault(ports_.faults[*fault], ports_.fault_ranges[*fault], value); !good) return good;
  apply_fault(*fault, value, true);
  return {};
}

result::Result<void> FleetFloor::clear_fault(std::string_view name) {
  auto fault = find_fault(kFleetPlant, ports_.faults, name);
  if (!fault) return result::forward(fault);
  apply_fault(*fault, 0.0, false);
  return {};
}

void FleetFloor::apply_fault(std::size_t fault, double value, bool active) {
  const auto target = ports_.fault_targets[fault];
  const bool on = active && value != 0.0;
  if (target.kind == FleetFault::Block) {
    world_.set_present(blockages_[target.index], on);
    overlap_monitor_.set_present(target.index, on);
  } else if (target.kind == FleetFault::EmergencyStop) {
    emergency_stop_ = on;
  } else {
    apply_vehicle_fault(vehicles_[target.index], target.kind, value, active);
  }
}

void FleetFloor::apply_vehicle_fault(Vehicle& vehicle, FleetFault kind, double value, bool active) {
  const bool on = active && value != 0.0;
  ForkliftModes modes = vehicle.forklift->modes();
  switch (kind) {
    case FleetFault::Dead:
      vehicle.dead = on;
      break;
    case FleetFault::Weak:
      modes.drive_strength = active ? value : 1.0;
      break;
    case FleetFault::Slip:
      modes.extra_slip = active ? value : 0.0;
      break;
    case FleetFault::StuckSteering:
      modes.steering_stuck = on;
      break;
    case FleetFault::FrozenPose:
      vehicle.frozen = on ? std::optional(vehicle.frozen.value_or(vehicle.forklift->pose())) : std::nullopt;
      break;
    case FleetFault::Drift:
      vehicle.drift_cm_s = active ? value : 0.0;
      vehicle.drift_since_s = time_s();
      break;
    case FleetFault::Block:
    case FleetFault::EmergencyStop:
      break;  // of the floor, not of a vehicle
  }
  vehicle.forklift->set_modes(modes);
}

}  // namespace stepwright::assemblies
