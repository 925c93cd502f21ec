#pragma once

// Driving times of a vehicle for each polygon when its program drives it and nobody holds it up: a schedule
// that is made with them can be kept. Pure.
//
//   for (VehicleMission& mission : plan.missions) set_driving_times(mission, options);
//   plan.schedule = schedule(envelopes_of(plan), plan.constraints, {});

#include "supervisor/fleet/program/fleet_program.h"

namespace stepwright::fleet {

// Puts the least stays and overlaps to what curves, braking, places of rest and services take.
void set_driving_times(VehicleMission& mission, const ProgramOptions& options);

}  // namespace stepwright::fleet
