#pragma once

// Check whether vehicles can stand where a problem has them begin and stop. Pure functions.

#include "supervisor/fleet/mission/internal/json_item.h"

namespace stepwright::fleet::internal {

// The lattice has poses every so far, and paths begin and end at them.
inline constexpr double kLattice_m = 0.2;

// The pose of the lattice that stands for this one.
geometry::Pose on_lattice(const OccupancyGrid& map, const geometry::Pose& pose);

// The obstacle at the pose, in words; empty if there is none.
std::string in_the_way(const OccupancyGrid& map, const VehicleModel& model, const geometry::Pose& pose);

// F0707: starts and places of which that is so for the vehicles that have to stand there, and vehicles that
// begin in each other's place.
void check_stands(const MissionProblem& problem, JsonComplaints& complaints);

}  // namespace stepwright::fleet::internal
