#pragma once

// Judges motion by the exact outline of a vehicle and the squares of blocked cells, independently of swept
// cells, spans and distance fields.
//
//   const auto hit = first_hit(grid, footprint, path);  // nothing: the path is free

#include <optional>

#include "supervisor/geometry/path.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::support {

// Whether the outline shares inner points with a blocked cell or leaves the map: separating axes against each
// cell near it.
bool outline_hits(const fleet::OccupancyGrid& grid, const geometry::Footprint& footprint,
                  const geometry::Pose& pose);

// The index of the first pose at which it does.
std::optional<std::size_t> first_hit(const fleet::OccupancyGrid& grid, const geometry::Footprint& footprint,
                                     const geometry::Path& path);

}  // namespace stepwright::support
