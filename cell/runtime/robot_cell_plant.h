#pragma once

// A robot cell as a cell's configuration has it. Pure but for reading the robot's file.
//
//   auto parameters = robot_cell_parameters(config.plant);
//   auto cell = assemblies::RobotCell::create(*parameters);

#include <vector>

#include "cell/config/cell_config.h"
#include "plant_models/assemblies/robot_cell_parameters.h"
#include "plant_models/bridge/plant_driver.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_runtime {

// Fails with what is wrong with the robot (cell/robot/robot_figures.h), and with C0322, each at the place of
// what is to blame: an arm or an object that is in something at the start.
[[nodiscard]] result::Result<assemblies::RobotCellParameters> robot_cell_parameters(
    const config::PlantConfig& plant);

// The wires without [plant.ports].
std::vector<bridge::PortWire> robot_cell_wires(const config::PlantConfig& plant);

}  // namespace stepwright::cell_runtime
