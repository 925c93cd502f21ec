#pragma once

// Places on its way where a program has a vehicle wait for others, and from where on it has left a polygon.
// Planning and program go by the same places: whoever plans with them (set_driving_times) never has vehicles
// wait for each other for ever. Pure.
//
//   const WaitPlaces places = wait_places(mission, options.margins);
//   polygon.left_into = places.left_into[k] - k;

#include <cstddef>
#include <vector>

#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

struct FleetMargins {
  double halt_before_m = 0.15;  // of the entry of a polygon that a vehicle may not enter yet
  double left_behind_m = 0.1;   // of the way behind a polygon's exit, until others take it for left
  double outside_m = 0.1;       // by which the outline may be measured outside of its polygons
};

struct WaitPlaces {
  // By polygon, along the path: up to where the vehicle may drive while it may not enter it ...
  std::vector<double> halt_m;
  // ... and from where on others may take it for left. That is behind its exit, or earlier, where the vehicle
  // is all within the next one and would have to wait before it has come so far.
  std::vector<double> free_m;
  // The polygon that it has entered by then at the latest. Nobody leaves the last one.
  std::vector<std::size_t> left_into;
  // By stop: the polygon that has to be entered to come there.
  std::vector<std::size_t> stops_in;
};

// Requires a visit for each polygon, and stops in the order of the way.
WaitPlaces wait_places(const VehicleMission& mission, const FleetMargins& margins);

}  // namespace stepwright::fleet
