#pragma once

// Terminals, truths and faults of a floor with forklifts by name, in the order in which they are numbered.

#include <cstdint>
#include <vector>

#include "plant_models/assemblies/fleet_parameters.h"
#include "plant_models/assemblies/port_target.h"
#include "plant_models/core/plant_description.h"
#include "plant_models/core/port.h"

namespace stepwright::assemblies {

enum class FleetActuator : std::uint8_t { Enable, Speed, Lock, Lift };
enum class FleetSensor : std::uint8_t {
  X,
  Y,
  Heading,
  Speed,
  Lock,
  Lifted,
  Lowered,
  Loaded,
  Bumper,
  EmergencyStop
};
enum class FleetTruth : std::uint8_t {
  X,
  Y,
  Heading,
  Speed,
  Lock,
  LoadedWith,  // number of the pallet, 0 = none
  PalletX,
  PalletY,
  PalletAngle,
  PalletState,  // 1 = stands on the floor, 2 = is carried
  Blocked,      // index: of the blockage
  Contacts,
  GreatestForce,
  Overlaps,  // as OverlapMonitor counts them
  ObstacleOverlaps,
  SmallestGap,
};
enum class FleetFault : std::uint8_t {
  Dead,
  Weak,
  Slip,
  StuckSteering,
  FrozenPose,
  Drift,
  Block,
  EmergencyStop,
};

struct FleetPorts {
  std::vector<core::Port> actuators;
  std::vector<PortTarget<FleetActuator>> actuator_targets;  // index: of the vehicle
  std::vector<core::Port> sensors;
  std::vector<PortTarget<FleetSensor>> sensor_targets;
  std::vector<core::Quantity> truths;
  std::vector<PortTarget<FleetTruth>> truth_targets;  // index: of the vehicle or pallet
  std::vector<core::Quantity> faults;
  std::vector<PortTarget<FleetFault>> fault_targets;
  std::vector<FaultRange> fault_ranges;
};

FleetPorts make_ports(const FleetParameters& parameters);

core::PlantDescription describe_fleet(const FleetParameters& parameters);

}  // namespace stepwright::assemblies
