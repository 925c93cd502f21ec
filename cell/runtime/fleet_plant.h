#pragma once

// A floor with forklifts as a cell's configuration has it: the map's blocked cells become walls. Pure but for
// reading the map.
//
//   auto parameters = fleet_parameters(config.plant);
//   auto floor = assemblies::FleetFloor::create(*parameters);

#include <vector>

#include "cell/config/cell_config.h"
#include "plant_models/assemblies/fleet_parameters.h"
#include "runtime/ground/result/result.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::cell_runtime {

// Rectangles that cover the blocked cells and no others, each as long as it can be in a row and then as high,
// and a wall around the map: far fewer than cells.
std::vector<assemblies::BlockParameters> walls_of(const fleet::OccupancyGrid& grid);

// Fails with what is wrong with the map (F0101 to F0104) and with C0322, at its place: a vehicle stands in a
// wall, outside of the map or in another vehicle; a pallet stands in a wall.
[[nodiscard]] result::Result<assemblies::FleetParameters> fleet_parameters(const config::PlantConfig& plant);

}  // namespace stepwright::cell_runtime
