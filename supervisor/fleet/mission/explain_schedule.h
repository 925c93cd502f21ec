#pragma once

// Explanations of schedules, in words that name vehicles, places of the floor and lines of the problem. Pure
// functions; any thread.
//
//   for (const Wait& wait : waits_of(plan)) print(wait);   // who waits for whom, where, for how long

#include <chrono>
#include <string>
#include <vector>

#include "supervisor/fleet/mission/mission_problem.h"
#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

// A vehicle enters a polygon as late as it does because another one leaves its own no sooner.
struct Wait {
  std::uint32_t waiting = 0;  // vehicles
  std::uint32_t first = 0;
  std::uint32_t polygon = 0;  // of the one that waits
  geometry::Point place;      // the middle of that polygon
  std::chrono::milliseconds from{0};
  std::chrono::milliseconds until{0};
};

// In the order of time; those in which nobody is held up by a tenth of a second are left out.
std::vector<Wait> waits_of(const FleetPlan& plan);

// Why there is no schedule, a sentence a line: which vehicles meet where, which constraints take part. `keys`
// of the problem's file may be given for the plan's constraints.
std::string reason_of(const FleetPlan& plan, const Core& core, const MissionProblem* problem,
                      const std::vector<std::string>& keys);

}  // namespace stepwright::fleet
