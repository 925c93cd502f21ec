#pragma once

// Terminals, truths and faults of a sorting line by name, in the order in which they are numbered.

#include <cstdint>
#include <vector>

#include "plant_models/assemblies/line_layout.h"
#include "plant_models/assemblies/port_target.h"
#include "plant_models/core/plant_description.h"
#include "plant_models/core/port.h"

namespace stepwright::assemblies {

enum class LineActuator : std::uint8_t { Belt, Pusher, Contactor };
enum class LineSensor : std::uint8_t {
  Eye,
  Home,           // a pusher is all the way back
  Out,            // a pusher is all the way out
  Contactor,      // its feedback contact
  EmergencyStop,  // 1 = nobody presses it
  Reset,
  Reader,        // number of the box in front of it, 0 = none
  ReaderLength,  // of that box in mm
  ReaderColour,  // of that box, 1..3
  Counter,       // boxes that passed a chute's beam
};
enum class LineTruth : std::uint8_t {
  BoxX,
  BoxY,
  BoxAngle,
  BoxState,  // BoxState
  BoxChute,  // from 1; 0 = in none
  BoxRank,   // its place among those that its chute got, from 1; 0 = in none
  BeltSpeed,
  PusherTravel,
  Delivered,
  OnTheLine,
  Energy,
  GreatestForce,
  Collisions,
};
enum class LineFault : std::uint8_t {
  Obstacle,
  StuckPusher,
  StuckEye,
  Slip,
  TakenAway,
  Exchange,
  EmergencyStop,
  Reset,
};

struct LinePorts {
  std::vector<core::Port> actuators;
  std::vector<PortTarget<LineActuator>> actuator_targets;
  std::vector<core::Port> sensors;
  std::vector<PortTarget<LineSensor>> sensor_targets;
  std::vector<core::Quantity> truths;
  std::vector<PortTarget<LineTruth>> truth_targets;
  std::vector<core::Quantity> faults;
  std::vector<PortTarget<LineFault>> fault_targets;
  std::vector<FaultRange> fault_ranges;
};

LinePorts make_ports(const LineLayout& layout, std::size_t boxes);

// For viewers; the sizes of the boxes are those of the seed.
core::PlantDescription describe_line(const LineParameters& parameters);

}  // namespace stepwright::assemblies
