#pragma once

// A fleet's plan as one picture: the floor with paths, envelopes and critical sections, below it who is in
// which polygon when. A pure function.
//
//   write("plan.svg", fleet_svg(answer.plan, &floor.map()));

#include <string>

#include "supervisor/fleet/plan/fleet_plan.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet {

// Without a map: the polygons alone. Without a schedule: no times.
std::string fleet_svg(const FleetPlan& plan, const OccupancyGrid* map);

}  // namespace stepwright::fleet
