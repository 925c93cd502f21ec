#pragma once

// Proof that stops that are given leave no schedule on any paths. Where paths that were found leave none,
// others might, unless all paths are given. Two reasons are seen without looking at all paths:
//  - times alone: even the shortest ways there can be do not meet the constraints;
//  - a vehicle that never moves closes the way of another one.
// No answer is no proof: there may be a schedule on other paths, or none.
//
// Pure functions; any thread.

#include <atomic>
#include <vector>

#include "supervisor/fleet/mission/internal/route.h"
#include "supervisor/fleet/schedule/problem.h"

namespace stepwright::fleet::internal {

struct ProofInput {
  const MissionProblem& problem;  // without goals: who stops where is given
  const FleetFloor& floor;
  const std::vector<Route>& routes;
  const std::vector<VehicleMission>& missions;  // in the order of the problem's vehicles
  Mode mode = Mode::Strict;
  const std::atomic<bool>* cancel = nullptr;
};

bool no_paths_help(const ProofInput& input);

}  // namespace stepwright::fleet::internal
