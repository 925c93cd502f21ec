#pragma once

// Context of a search for other paths: its inputs and budgets, the search for paths, and the check whether a
// set of missions has a schedule. A value; its parts outlive it.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "supervisor/fleet/mission/internal/route.h"
#include "supervisor/fleet/mission/plan_fleet.h"

namespace stepwright::fleet::internal {

// Effort of searches for other paths, counted alike on every machine.
struct SearchWork {
  std::uint64_t conflicts = 0;  // of searches for orders
  std::uint64_t expanded = 0;   // of searches for paths
};

// Whether one of the budgets of the options is used up.
bool used_up(const SearchWork& work, const FleetOptions& options);

struct Attempt {
  const MissionProblem& problem;
  const FleetFloor& floor;
  const FleetOptions& options;
  const std::vector<Route>& routes;
  SearchWork& work;
  std::chrono::steady_clock::time_point until;  // the latest, if there is a limit
  bool limited = false;
  std::function<void(std::size_t tried)> on_tried;

  // Somebody has cancelled it, or time or one of the counted budgets has ended.
  bool over() const;
  // The first schedule of these missions, without an objective; stops are those of the routes.
  Schedule schedule_of(const std::vector<Route>& stops, const std::vector<VehicleMission>& missions) const;
  // Paths from there through the stops, whose locations are those of `places`, one after the other. Nothing
  // if there is none to one of them, or it is over before it is found.
  std::optional<std::vector<LatticePath>> paths_through(const MissionProblem& places,
                                                        const geometry::Pose& from, const Route& stops,
                                                        const PathPlanner& planner, PathOptions asked) const;
};

double length_m(const VehicleMission& mission);
// As the parts of a mission want them; the paths must outlive them.
std::vector<const LatticePath*> borrowed(const std::vector<LatticePath>& paths);

}  // namespace stepwright::fleet::internal
