#pragma once

// Distance field: exact distances to the nearest obstacle, at the corners of all cells (Felzenszwalb and
// Huttenlocher 2012, Distance Transforms of Sampled Functions).
//
// A value that does not change; any thread may read. The nearest point of a blocked square to a corner of the
// grid is a corner of that square: the transform of corners is therefore the distance to the blocked area
// itself, not to the middle of cells. What lies outside the map is blocked.
//
//   const DistanceField clearance(floor);
//   clearance.at_corner({3, 4});  // metres from the lower left corner of cell (3, 4); 0 at an obstacle

#include <vector>

#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet {

class DistanceField {
 public:
  explicit DistanceField(const OccupancyGrid& grid);

  // Requires 0 <= column <= columns and 0 <= row <= rows of the grid.
  float at_corner(Cell corner) const {
    return metres_[static_cast<std::size_t>(corner.row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(corner.column)];
  }

 private:
  std::int32_t columns_ = 0;  // of corners: one more than of cells
  std::vector<float> metres_;
};

}  // namespace stepwright::fleet
