#pragma once

// Baseline of the lattice planner: A* over the same primitives as one would write it first. A hash map of
// poses, a binary heap, distance to obstacles and exact outline every 0.1 m of a motion; the estimate is the
// greater of the straight line and the distance around obstacles, as in SBPL. Neither swept cells nor look-up
// table. Pure.

#include <cstdint>

#include "supervisor/fleet/lattice/obstacle_distances.h"
#include "supervisor/fleet/lattice/vehicle_model.h"

namespace stepwright::bench {

struct PlainResult {
  bool found = false;
  std::uint32_t cost_mm = 0;
  std::uint64_t expanded = 0;
};

// Cells as large as the distance between vertices; poses that the planner has accepted.
PlainResult plain_search(const fleet::OccupancyGrid& grid, const fleet::VehicleModel& vehicle,
                         const fleet::PrimitiveSet& primitives, const geometry::Pose& start,
                         const geometry::Pose& goal);

}  // namespace stepwright::bench
