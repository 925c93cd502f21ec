#pragma once

// Reachable poses of a vehicle from a pose, those first that are cheapest to drive to (Dijkstra 1959). For
// places that are known by what they are like, and not by where they are.
//
// A pure function; any thread. The same floor gives the same poses in the same order.
//
//   planner.visit_reachable(start, 50'000,
//                           [&](const geometry::Pose& at, std::uint32_t) { return !good(at); });

#include <cstddef>
#include <cstdint>
#include <functional>

#include "supervisor/fleet/lattice/swept_cells.h"
#include "supervisor/geometry/point.h"

namespace stepwright::fleet {

// A pose of the lattice and what it costs to drive there, as paths are paid for; false: that is enough.
using TakePose = std::function<bool(const geometry::Pose&, std::uint32_t cost_mm)>;

// The start first. Ends as well behind `most` poses. Requires a start in which the vehicle can stand. How
// many poses were shown.
std::size_t visit_reachable(const OccupancyGrid& map, const DistanceField& clearance,
                            const PrimitiveSet& primitives, const SweptCells& cells, GridVector start,
                            int heading, std::size_t most, const TakePose& take);

}  // namespace stepwright::fleet
