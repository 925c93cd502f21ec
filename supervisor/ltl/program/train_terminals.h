#pragma once

// Terminals of a train in the process image. Values.
//
//   const TrainTerminals terminals = train_terminals_in_a_row(5, 8);
//   terminals.at[2];   // "%IX25.2"

#include <cstddef>
#include <string>
#include <vector>

namespace stepwright::ltl {

// Addresses of directly represented variables. Words count as plant_models/doc/tugger.md says: cm, 0.01
// degrees, mm/s.
struct TrainTerminals {
  std::string x, y, heading, speed, lock;  // words
  std::vector<std::string> hitches;        // words, one for each trailer that can be coupled
  std::string trailers;                    // word: how many are coupled
  std::string bumper, estop_ok, way_free;  // switches
  std::vector<std::string> at;             // switches: the car is in the place
  std::string set_speed, set_lock;         // words
  std::string enable;                      // relay
};

// All words of inputs, then a byte with bumper, estop_ok and way_free, then the places; outputs likewise.
TrainTerminals train_terminals_in_a_row(std::size_t trailers, std::size_t places);

}  // namespace stepwright::ltl
