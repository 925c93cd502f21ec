#pragma once

// The equations of a type that a plant's file describes, as texts that were found right; plain data.

#include <string>
#include <vector>

#include "plant_models/components/unit.h"
#include "runtime/ground/result/result.h"

namespace stepwright::components {

// What an equation sets or reads of a port.
struct OwnPlace {
  std::size_t port = 0;
  bool through = false;  // else: across
  bool fluid = false;
};

struct OwnRead {
  std::string name;
  Dimension dimension{};
  OwnPlace place{};
};

struct OwnOutput {
  std::string text;
  OwnPlace place{};
  std::uint32_t stage = 0;
  bool is_switch = false;
};

struct OwnState {
  std::string name;
  Dimension dimension{};
  std::string start;
  result::Location start_where{};
  std::string derivative;
  double tolerance = 1e-6;
  bool liquid = false;
};

struct OwnEvent {
  std::string name;
  std::string when;  // crosses zero
  bool falling = false;
  bool rising = true;
  std::vector<std::pair<std::size_t, std::string>> set;  // states
};

struct OwnEquations {
  std::vector<std::pair<std::string, Dimension>> parameters;
  std::vector<std::pair<std::string, Dimension>> faults;
  std::vector<OwnRead> reads;
  std::vector<OwnState> states;
  std::vector<OwnOutput> outputs;
  std::vector<OwnEvent> events;
};

}  // namespace stepwright::components
