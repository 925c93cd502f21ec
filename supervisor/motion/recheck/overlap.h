#pragma once

// Things of a world that stand in each other: mistakes of who wrote it, most often. A function without state;
// any thread.
//
//   for (const auto& [a, b] : overlapping(world, 1e-3)) ...

#include <cstddef>
#include <utility>
#include <vector>

#include "supervisor/motion/collision/world.h"

namespace stepwright::motion {

// Numbers of obstacles of different names that are in each other by more than about `deeper_than_m`: their
// bodies meet even when each is thinner by half of that on every side. Meshes are not made thinner. Requires
// check_world.
std::vector<std::pair<std::size_t, std::size_t>> overlapping(const World& world, double deeper_than_m);

}  // namespace stepwright::motion
