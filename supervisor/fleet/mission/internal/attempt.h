#pragma once

// What a search for other paths is given, and how it asks whether a set of missions has a schedule. A value;
// its parts outlive it.

#include <chrono>
#include <functional>
#include <vector>

#include "supervisor/fleet/mission/internal/route.h"
#include "supervisor/fleet/mission/plan_fleet.h"

namespace stepwright::fleet::internal {

struct Attempt {
  const MissionProblem& problem;
  const FleetFloor& floor;
  const FleetOptions& options;
  const std::vector<Route>& routes;
  std::chrono::steady_clock::time_point until;  // the latest, if there is a limit
  bool limited = false;
  std::function<void(std::size_t tried)> on_tried;

  // Somebody has cancelled it, or the time has ended.
  bool over() const;
  // The first schedule of these missions, without an objective; stops are those of the routes.
  Schedule schedule_of(const std::vector<Route>& stops, const std::vector<VehicleMission>& missions) const;
};

double length_m(const VehicleMission& mission);

}  // namespace stepwright::fleet::internal
