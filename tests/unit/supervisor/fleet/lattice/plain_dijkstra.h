#pragma once

// Least costs on the lattice by Dijkstra's algorithm as textbooks have it: no estimate, no tables, every cell
// of a motion looked at. What A* is held against.

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

#include "supervisor/fleet/lattice/swept_cells.h"

namespace stepwright::fleet {

using PlainPose = std::tuple<std::int32_t, std::int32_t, int>;  // vertex and heading
using PlainCosts = std::map<PlainPose, std::uint32_t>;

struct PlainFloor {
  const OccupancyGrid* grid = nullptr;  // nothing: endless and free
  const PrimitiveSet& primitives;
  const SweptCells* cells = nullptr;
};

bool plain_free(const PlainFloor& floor, const PlainPose& pose, std::size_t primitive);

// To every pose that costs at most `most`, or to `goal` and all that are nearer.
PlainCosts plain_costs(const PlainFloor& floor, const PlainPose& start, std::uint32_t most,
                       std::optional<PlainPose> goal = std::nullopt);

}  // namespace stepwright::fleet
