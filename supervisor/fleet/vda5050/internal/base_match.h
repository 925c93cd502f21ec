#pragma once

// Match of another mission with the base of an order: whether it goes on where the base leads. Pure; any
// thread.
//
//   const auto match = match_base(order, next_mission);
//   if (match) order.lay(next_mission, route_of(next_mission, options, match->decision_pose), ...);

#include <optional>

#include "supervisor/fleet/vda5050/internal/vehicle_order.h"

namespace stepwright::fleet::vda5050 {

struct BaseMatch {
  std::size_t decision_pose = 0;  // of the mission's path: where the base ends
  double decision_arc_m = 0.0;    // of that pose
};

// The path begins on what is left of the base, or at its end, follows it within a centimetre, and has the
// same work on it.
std::optional<BaseMatch> match_base(const VehicleOrder& order, const VehicleMission& mission);

// Length of the way from node to node of the base.
double base_length_m(const VehicleOrder& order, std::size_t from, std::size_t to);

}  // namespace stepwright::fleet::vda5050
