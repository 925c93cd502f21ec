#pragma once

// Disturbance of a run of the fleet's campaign, and its moment: by its seed alone. Pure.
//
//   const FleetMoment moment = fleet_moment(30, locations, vehicles);

#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/fleet/executive/fleet_request.h"
#include "supervisor/fleet/mission/mission_problem.h"
#include "tests/support/controller/simulated_controller.h"

namespace stepwright::campaign {

enum class FleetKind : std::uint8_t { Order, Block, Death, Return };

struct FleetMoment {
  std::uint64_t seed = 0;
  FleetKind kind = FleetKind::Order;
  std::string story;  // "dead_v3 = 1 at 41.2 s"
  double from_s = 0.0;
  double until_s = 0.0;  // the place is free again, the vehicle is asked to return; 0: never
  std::string vehicle;   // that dies, as the problem names it
  std::vector<support::PlantFault> faults;
  std::vector<fleet::TimedRequest> requests;
};

// The kinds take turns, seed modulo 4; moments are spread over the time that the undisturbed job takes.
FleetMoment fleet_moment(std::uint64_t seed, const fleet::MissionProblem& problem);

const char* to_string(FleetKind kind);

}  // namespace stepwright::campaign
