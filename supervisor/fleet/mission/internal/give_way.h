#pragma once

// Vehicles that first drive out of the way of others and go on when these have passed: for a fleet that
// stands so that there is no schedule on any paths, two of it face to face in an aisle, say.
//
// A best-first search over who gives way to where, fewest vehicles first, then the shortest ways. Places are
// the nearest poses of the lattice that a vehicle can reach past all who do not move, and where its outline
// with the room of a stand overlaps no polygon of anybody else. Each set that is tried costs two paths, an
// envelope and a schedule, so that their number is bounded, and so is that of vehicles that give way. Those
// without anything to do are asked first.

#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/mission/internal/attempt.h"

namespace stepwright::fleet::internal {

struct WayGiven {
  std::vector<VehicleMission> missions;
  std::vector<Route> routes;  // with the stops to give way, which have no location of the problem
  Schedule schedule;          // the first one found, without an objective
  std::vector<GaveWay> vehicles;
};

struct WayGivenAnswer {
  std::optional<WayGiven> found;
  std::size_t tried = 0;
  std::string reason;  // without one: why, a sentence a line
};

// `missions` have no schedule, and `core` is why. FleetOptions::give_way vehicles at most give way.
WayGivenAnswer give_way(const Attempt& input, const std::vector<VehicleMission>& missions, const Core& core);

}  // namespace stepwright::fleet::internal
