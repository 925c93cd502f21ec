#pragma once

// The floor of a ROS map: its free cells within its bounds, blocked ones as obstacles, joined to rectangles
// that are as large as they can be made row by row. A pure function; any thread.
//
//   Floor floor = floor_of(*fleet::read_map("hall/map.yaml"), "hall/map.yaml");

#include <string>

#include "supervisor/ltl/regions/make_regions.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::ltl {

// `file` names the map in messages. Propositions are for the caller to add.
Floor floor_of(const fleet::OccupancyGrid& grid, const std::string& file);

}  // namespace stepwright::ltl
