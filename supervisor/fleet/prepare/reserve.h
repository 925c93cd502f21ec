#pragma once

// Reserve of a plan for the control of the vehicles: room around the outline and wider curves. Planned to the
// last centimetre and at full lock, nothing is left to steer with. Pure; any thread.
//
//   auto floor = FleetFloor::create(problem.map, models_of(with_reserve(problem, {})), {});

#include "supervisor/fleet/mission/mission_problem.h"

namespace stepwright::fleet {

struct DriveReserve {
  double room_m = 0.15;   // around the outline
  double radius_m = 0.5;  // that curves are wider than the vehicle's narrowest
};

VehicleModel with_reserve(VehicleModel model, const DriveReserve& reserve);
// The problem with such vehicles; nothing else of it changes.
MissionProblem with_reserve(MissionProblem problem, const DriveReserve& reserve);

}  // namespace stepwright::fleet
