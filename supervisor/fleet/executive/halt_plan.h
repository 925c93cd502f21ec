#pragma once

// Halt plan, by which a fleet comes to rest between two plans: each vehicle drives on along its way as far as
// its chart lets it already, and no farther than it needs, then stands. A pure function.
//
// No vehicle needs a new permission: its polygons are those that it is in or may enter, and no two of
// different vehicles overlap, because the interlocks admit a vehicle only after the other one has left. So no
// order is to be decided, and the halt always exists.
//
//   const HaltPlan halt = halt_plan(plan, program, reading, brake, frame);
//   controller.change(container_of(fleet_program(halt.plan, terminals, options)));

#include <vector>

#include "supervisor/fleet/executive/fleet_reading.h"
#include "supervisor/fleet/plan/fleet_plan.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet {

struct HaltPlan {
  FleetPlan plan;
  std::vector<double> begun_m;  // by vehicle: length of the old path at which the new one begins
};

// `program` is that of `plan`. A vehicle that has stopped by itself gets no way. Where there is one, vehicles
// come to rest at a pose of the lattice of `frame`.
HaltPlan halt_plan(const FleetPlan& plan, const FleetProgram& program, const FleetReading& reading,
                   const DriveData& drive, const GridFrame& frame);

}  // namespace stepwright::fleet
