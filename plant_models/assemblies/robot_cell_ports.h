#pragma once

// Terminals, truths and faults of a robot cell by name, in the order in which they are numbered. Pure; any
// thread.

#include <cstdint>
#include <vector>

#include "plant_models/assemblies/port_target.h"
#include "plant_models/assemblies/robot_cell_parameters.h"
#include "plant_models/core/plant_description.h"
#include "plant_models/core/port.h"

namespace stepwright::assemblies {

// Indices: of a joint arm * 7 + joint; of the arm; of the camera's slot.
enum class CellActuator : std::uint8_t { Enable, Joint, Grip, Trigger };
enum class CellSensor : std::uint8_t {
  Joint,
  Width,
  Ready,
  Tripped,
  Grasping,
  EmergencyStop,
  Pictures,
  SeenCount,
  SeenKind,
  SeenX,
  SeenY,
  SeenZ,
  SeenYaw,
};
enum class CellTruth : std::uint8_t {
  Joint,
  Width,
  Held,
  ObjectX,
  ObjectY,
  ObjectZ,
  ObjectYaw,
  ObjectState,
  ObjectOn,
  Blocked,
  Incidents,  // index: IncidentKind
  SmallestGap,
  WorstTilt,
};
enum class CellFault : std::uint8_t {
  Stuck,
  Runaway,
  Overcurrent,
  Slippery,
  DropIt,
  DeadHand,
  CameraDead,
  CameraLoss,
  CameraGhosts,
  CameraOffsetX,
  CameraOffsetY,
  ShiftX,
  ShiftY,
  Block,
  EmergencyStop,
};

struct RobotCellPorts {
  std::vector<core::Port> actuators;
  std::vector<PortTarget<CellActuator>> actuator_targets;
  std::vector<core::Port> sensors;
  std::vector<PortTarget<CellSensor>> sensor_targets;
  std::vector<core::Quantity> truths;
  std::vector<PortTarget<CellTruth>> truth_targets;
  std::vector<core::Quantity> faults;
  std::vector<PortTarget<CellFault>> fault_targets;
  std::vector<FaultRange> fault_ranges;
};

RobotCellPorts make_ports(const RobotCellParameters& parameters);

core::PlantDescription describe_robot_cell(const RobotCellParameters& parameters);

}  // namespace stepwright::assemblies
