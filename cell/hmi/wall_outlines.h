#pragma once

// The blocked cells of a map as closed lines, so that a viewer gets a few thousand numbers instead of the
// cells.
//
// Pure. Invariant: a cell lies inside of an odd number of lines exactly if it is blocked, unless the map was
// made coarser to stay within `most_numbers`: then a cell is blocked if one of those that it stands for is.
//
//   protocol::FloorMap map = outlined(*fleet::read_map("map.yaml"));

#include <cstddef>

#include "hmi_web/protocol/floor.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::hmi {

inline constexpr std::size_t kMostOutlineNumbers = 40'000;

protocol::FloorMap outlined(const fleet::OccupancyGrid& grid, std::size_t most_numbers = kMostOutlineNumbers);

}  // namespace stepwright::hmi
