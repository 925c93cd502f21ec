#pragma once

// Constraints of a problem as constraints on polygons. Pure functions.
//
// A stop ends with the exit of the polygon in which it takes place. It begins when the vehicle has driven
// from that polygon's border to the stop at its greatest speed. Where a goal has several trips, a constraint
// holds for each of them.

#include <vector>

#include "supervisor/fleet/mission/internal/route.h"

namespace stepwright::fleet::internal {

struct MappedConstraints {
  std::vector<TemporalConstraint> constraints;
  std::vector<std::string> keys;  // in the problem's file, one for each
};

// Missions and routes in the order of the problem's vehicles.
MappedConstraints map_constraints(const MissionProblem& problem, const std::vector<Route>& routes,
                                  const std::vector<VehicleMission>& missions);

}  // namespace stepwright::fleet::internal
