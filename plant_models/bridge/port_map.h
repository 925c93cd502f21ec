#pragma once

// Wires checked against a plant and the image: what PlantDriver is built from.

#include <cstdint>
#include <span>
#include <vector>

#include "plant_models/bridge/io_address.h"
#include "plant_models/bridge/plant_driver.h"

namespace stepwright::bridge {

// A wire whose port exists, whose address fits the port and lies in its area.
struct CheckedWire {
  bool is_actuator = false;
  core::PortKind kind = core::PortKind::Bool;
  std::uint32_t port = 0;  // index into Plant::actuators() or Plant::sensors()
  IoAddress address;
};

// Fails as PlantDriver::create() says, with a diagnostic for every wrong wire.
[[nodiscard]] result::Result<std::vector<CheckedWire>> check_wires(const core::Plant& plant,
                                                                   std::span<const PortWire> wires,
                                                                   AreaSizes sizes);

}  // namespace stepwright::bridge
