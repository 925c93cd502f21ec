#pragma once

// Poses of a mission's path that say where it goes: a planned path has one every 5 cm, most of which lie
// between their neighbours. What the others say of those between is true to a centimetre. A pure function.
//
//   for (const std::size_t k : telling_poses(mission)) send(mission.path[k]);

#include <cstddef>
#include <vector>

#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

// Ascending; with both ends, each stop, each turn back, and the poses at which polygons are entered and left.
std::vector<std::size_t> telling_poses(const VehicleMission& mission);

}  // namespace stepwright::fleet
