#pragma once

// Terminals, truths and faults of a tugger train and its hall by name, in the order in which they are
// numbered.

#include <cstdint>
#include <vector>

#include "plant_models/assemblies/port_target.h"
#include "plant_models/assemblies/tugger_parameters.h"
#include "plant_models/core/plant_description.h"
#include "plant_models/core/port.h"

namespace stepwright::assemblies {

enum class TuggerActuator : std::uint8_t { Enable, Speed, Lock };
enum class TuggerSensor : std::uint8_t {
  X,
  Y,
  Heading,
  Speed,
  Lock,
  Hitch,  // index: of the trailer, from 1
  Trailers,
  Bumper,
  EmergencyStop,
  WayFree,
  AtPlace,  // index: of the place
};
enum class TuggerTruth : std::uint8_t {
  X,  // index: of the link, 0 the tractor
  Y,
  Heading,
  Speed,
  Lock,
  Trailers,
  LinkState,  // index: of the trailer; 0 = not there, 1 = coupled, 2 = left standing
  Blocked,    // index: of the blockage
  Contacts,
  SmallestGap,
};
enum class TuggerFault : std::uint8_t {
  Dead,
  Weak,
  Slip,
  StuckSteering,
  FrozenPose,
  Drift,
  Block,
  EmergencyStop,
  LeaveTrailers,
  CoupleTrailers,
};

struct TuggerPorts {
  std::vector<core::Port> actuators;
  std::vector<PortTarget<TuggerActuator>> actuator_targets;
  std::vector<core::Port> sensors;
  std::vector<PortTarget<TuggerSensor>> sensor_targets;
  std::vector<core::Quantity> truths;
  std::vector<PortTarget<TuggerTruth>> truth_targets;
  std::vector<core::Quantity> faults;
  std::vector<PortTarget<TuggerFault>> fault_targets;
  std::vector<FaultRange> fault_ranges;
};

TuggerPorts make_ports(const TuggerParameters& parameters);

core::PlantDescription describe_tugger(const TuggerParameters& parameters);

}  // namespace stepwright::assemblies
