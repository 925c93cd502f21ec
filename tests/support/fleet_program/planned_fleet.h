#pragma once

// Plans of the fleet for tests: paths on drawn floors, envelopes with room for what a controller does not
// hold, and a schedule.
//
//   const FleetPlan plan = plan_mine(3);

#include <cstddef>
#include <vector>

#include "supervisor/fleet/plan/fleet_plan.h"
#include "tests/support/fleet/floor_maps.h"

namespace stepwright::fleet {

struct DrawnMission {
  geometry::Pose start;
  std::vector<geometry::Pose> goals;  // each with a stop
};

// Throws where there is no path or no schedule.
FleetPlan plan_missions(const OccupancyGrid& grid, const std::vector<DrawnMission>& missions,
                        Mode mode = Mode::Strict);

// The first `vehicles` (up to seven) of the tasks in the mine.
FleetPlan plan_mine(std::size_t vehicles);
// Up to five vehicles between the aisles of a warehouse.
FleetPlan plan_warehouse(std::size_t vehicles);

// One vehicle along this path, in one polygon around all of it.
FleetPlan plan_alone(const geometry::Path& path);

}  // namespace stepwright::fleet
