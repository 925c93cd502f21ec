#pragma once

// Reader of the image of a fleet's program: where each vehicle is on its way, what it stands at, what has
// stopped it.
//
// Immutable; any thread. An image that is too short reads as zeros.
//
//   auto reader = FleetReader::create(container, program);
//   const FleetReading now = reader->read(event.image);
//   if (now.vehicles[2].error != 0) ...

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"
#include "supervisor/fleet/program/fleet_program.h"
#include "supervisor/geometry/point.h"

namespace stepwright::fleet {

struct VehicleReading {
  double arc_m = 0.0;       // along its path
  std::uint32_t areas = 0;  // polygons that it has left
  std::uint32_t error = 0;  // ErrorID (ladder/driver/library/vehicle.st)
  double speed_m_s = 0.0;   // negative in reverse
  bool standing = false;
  bool forks_at_end = true;  // up or down, not between
  geometry::Pose pose;       // as it is estimated
  std::size_t step = 0;      // the active one of its chart, as in MissionProgram::steps
};

struct FleetReading {
  std::vector<VehicleReading> vehicles;  // in the order of the missions
  bool emergency_stop = false;
};

class FleetReader {
 public:
  // X0002: the program lacks a chart or a variable. Fails too where the container is not valid.
  [[nodiscard]] static result::Result<FleetReader> create(std::span<const std::byte> container,
                                                          const FleetProgram& program);

  FleetReading read(std::span<const std::byte> image) const;

 private:
  struct Vehicle {
    reader::Variable arc, areas, error, speed, standing, lifted, lowered, x, y, heading;
    std::vector<reader::Variable> steps;  // their bits
  };
  std::vector<Vehicle> vehicles_;
  reader::Variable estop_ok_;
};

}  // namespace stepwright::fleet
