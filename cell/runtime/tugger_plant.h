#pragma once

// A tugger train in its hall as a cell's configuration has it. Pure but for reading scene and map.
//
//   auto parameters = tugger_parameters(config.plant);
//   auto tugger = assemblies::Tugger::create(*parameters);

#include <vector>

#include "cell/config/cell_config.h"
#include "plant_models/assemblies/tugger_parameters.h"
#include "plant_models/bridge/plant_driver.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_runtime {

// Fails with what is wrong with the scene (E0001, L0401 to L0405, L0201) or the map (F0101 to F0104), with
// C0321 where an outline is no simple polygon, and with C0322, at the start's place: a link stands in a wall
// or outside of the hall.
[[nodiscard]] result::Result<assemblies::TuggerParameters> tugger_parameters(
    const config::PlantConfig& plant);

// The wires without [plant.ports]; none if the scene cannot be read, which tugger_parameters() tells.
std::vector<bridge::PortWire> tugger_wires(const config::PlantConfig& plant);

}  // namespace stepwright::cell_runtime
