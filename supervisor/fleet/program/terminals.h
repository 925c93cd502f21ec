#pragma once

// Terminals of the vehicles in the process image. Values.
//
//   const FleetTerminals terminals = terminals_in_a_row(3);
//   terminals.vehicles[1].x;   // "%IW5"

#include <cstddef>
#include <string>
#include <vector>

namespace stepwright::fleet {

// Addresses of directly represented variables. Words count as plant_models/doc/forklift.md says: cm, 0.01
// degrees, mm/s.
struct VehicleTerminals {
  std::string x, y, heading, speed, lock;       // words
  std::string lifted, lowered, loaded, bumper;  // switches
  std::string set_speed, set_lock;              // words
  std::string enable, lift;                     // relays
};

struct FleetTerminals {
  std::vector<VehicleTerminals> vehicles;  // in the plan's order
  std::string estop_ok;                    // switch, off while the emergency stop is pressed
};

// All words of inputs, vehicle by vehicle, then a byte of switches for each, then the emergency stop; outputs
// likewise.
FleetTerminals terminals_in_a_row(std::size_t vehicles);

// Bytes of the image that these terminals take.
std::size_t input_bytes_in_a_row(std::size_t vehicles);
std::size_t output_bytes_in_a_row(std::size_t vehicles);

}  // namespace stepwright::fleet
