#pragma once

// Outside of a plant: its terminals, and quantities with a unit. Plain values; any thread.

#include <cstdint>
#include <string>

#include "runtime/base/strong_id.h"

namespace stepwright::core {

struct ActuatorTag;
struct SensorTag;
struct TruthTag;
using ActuatorId = base::StrongId<ActuatorTag>;  // index into Plant::actuators()
using SensorId = base::StrongId<SensorTag>;      // index into Plant::sensors()
using TruthId = base::StrongId<TruthTag>;        // index into Plant::truths()

enum class PortKind : std::uint8_t {
  Bool,   // a contact or a relay: 0 or 1
  Count,  // an analogue channel: signed 16-bit raw counts
};

// A terminal of the plant, to be wired to an address of the process image.
struct Port {
  std::string name;  // unique among the plant's actuators and sensors, e.g. "fc1"
  PortKind kind = PortKind::Bool;
  std::string meaning;  // one sentence
};

// A named number that is no terminal: a fault that can be injected, or a value of the true state.
struct Quantity {
  std::string name;  // unique in its list
  std::string unit;  // "percent", "l/s"; empty = dimensionless
  std::string meaning;
};

// Values of a fault, in its unit. Where they are the same, nothing is known of them.
struct FaultRange {
  double min = 0.0;
  double max = 1.0;
  bool whole = true;  // whole numbers only
};

}  // namespace stepwright::core
