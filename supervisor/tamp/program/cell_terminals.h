#pragma once

// Terminals of a robot cell in the process image, as plant_models/doc/robot_cell.md has them. Values.
//
//   const CellTerminals terminals = cell_terminals_in_a_row(2, 4);
//   terminals.arms[1].set[0];   // "%QW8"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace stepwright::tamp::program {

// Addresses of directly represented variables. Angles count 0.0001 rad, openings and places 0.1 mm.
struct ArmTerminals {
  std::array<std::string, 7> pos;  // words
  std::string width;               // word
  std::string ready, trip, grasp;  // switches
  std::array<std::string, 7> set;  // words
  std::string grip;                // word
  std::string enable;              // relay
};

// An object in the camera's last report; words.
struct SlotTerminals {
  std::string kind, x, y, z, yaw;
};

struct CellTerminals {
  std::vector<ArmTerminals> arms;            // in the cell's order
  std::string estop_ok;                      // switch
  std::string camera_trigger;                // relay
  std::string camera_pictures, camera_seen;  // words
  std::vector<SlotTerminals> slots;
};

// Where they are without [plant.ports].
CellTerminals cell_terminals_in_a_row(std::size_t arms, std::size_t slots);

// Bytes of the image that these terminals take.
std::size_t input_bytes_in_a_row(std::size_t arms, std::size_t slots);
std::size_t output_bytes_in_a_row(std::size_t arms);

}  // namespace stepwright::tamp::program
