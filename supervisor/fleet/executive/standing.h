#pragma once

// Vehicles that stand for good as part of a plan: one pose, one polygon, nothing to do, so that its program
// holds their brakes and viewers still see them. Pure functions.
//
//   insert_standing(plan, 2, "truck 3", model, pose, place_of(pose, outline, 0.75, 0.1));

#include <cstdint>
#include <string>

#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

// The outline with so much room before and behind it, and beside it.
geometry::ConvexPolygon place_around(const geometry::Pose& pose, const geometry::Footprint& outline,
                                     double along_m, double beside_m);

// Becomes mission number `vehicle`; those behind it and what speaks of them count on. The plan has a
// schedule, and nothing else of it lies in `place`.
void insert_standing(FleetPlan& plan, std::uint32_t vehicle, const std::string& name,
                     const VehicleModel& model, const geometry::Pose& pose,
                     const geometry::ConvexPolygon& place);

}  // namespace stepwright::fleet
