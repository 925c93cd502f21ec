#pragma once

// The hall of a cell's tugger train: the planner's scene (supervisor/ltl/scene), or a ROS map with one, as
// outlines of the plant. For the runtime, which simulates it, and for the page, which draws it. Any thread;
// pure but for reading scene and map.
//
//   auto parameters = hall_parameters(config.plant);
//   auto tugger = assemblies::Tugger::create(*parameters);

#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "plant_models/assemblies/tugger_parameters.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_hall {

// Fails with E0001, with what is wrong with the scene (L0401 to L0405, L0201) or with the map (F0101 to
// F0104). Whether the train stands in a wall is not looked at.
[[nodiscard]] result::Result<assemblies::TuggerParameters> hall_parameters(const config::PlantConfig& plant);

// Of the places, in the order of their terminals.
std::vector<std::string> place_names(const assemblies::TuggerParameters& parameters);

}  // namespace stepwright::cell_hall
