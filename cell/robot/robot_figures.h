#pragma once

// The robot of a cell's file, read as the planner reads it (supervisor/motion/robot), as plain numbers of the
// plant `robot_cell`: places, axes and limits of the joints, solids that hang on them. So the plant knows no
// URDF, and what the planner plans with moves in the plant. Pure but for reading the file.
//
//   assemblies::RobotCellParameters parameters;
//   if (auto read = read_robot(config.plant.robot_cell, parameters); !read) return result::forward(read);

#include "cell/config/robot_cell_config.h"
#include "plant_models/assemblies/robot_cell_parameters.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_robot {

// Fills in `arms` and adds to `fixed` what does not move of the robot. Fails with what is wrong with the file
// (A0101 to A0111, E0001), and with C0322, at the arm's place: no such link or gripper, no seven joints that
// turn, a start beyond its limits; at the robot's: a body that is a mesh.
[[nodiscard]] result::Result<void> read_robot(const config::RobotCellPlantConfig& cell,
                                              assemblies::RobotCellParameters& parameters);

}  // namespace stepwright::cell_robot
