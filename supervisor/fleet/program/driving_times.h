#pragma once

// How long a vehicle takes for each polygon when its program drives it and nobody holds it up: what a
// schedule needs, so that it can be kept. Pure.
//
//   for (VehicleMission& mission : plan.missions) set_driving_times(mission, options);
//   plan.schedule = schedule(envelopes_of(plan), plan.constraints, {});

#include "supervisor/fleet/program/fleet_program.h"

namespace stepwright::fleet {

// Puts the least stays and overlaps to what curves, braking, places of rest and services take.
void set_driving_times(VehicleMission& mission, const ProgramOptions& options);

}  // namespace stepwright::fleet
