#pragma once

// The fleet of a cell: whether the problem and the plant speak of the same floor and vehicles, and its first
// plan.

#include "cell/missions/mission_kinds.h"
#include "supervisor/fleet/executive/fleet_planning.h"

namespace stepwright::missions {

// C0543: another floor; C0544: a vehicle that stands elsewhere; X0003: an order or request that cannot be
// meant. The cost is the makespan in seconds.
[[nodiscard]] result::Result<FirstPlan> first_fleet_plan(const config::CellConfig& config,
                                                         fleet::FleetPlanning& planning);

}  // namespace stepwright::missions
