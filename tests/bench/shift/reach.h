#pragma once

// A deadline that nobody could keep: where a blocked place or a dead vehicle leaves no passage from where the
// load is to where it is to be. Knows the drawn floor and what stood on it when, nothing of planner, lattice
// or fleet.
//
// A lower bound for every fleet of vehicles that are at least so wide, wherever they are and whatever they
// know beforehand (supervisor/doc/fleet_traffic.md has the proof):
//  - somebody may stand where the load is at its release already, and takes it up at once;
//  - from place to place it takes no time at all, as long as a disc of the vehicle's half width, around its
//    reference point, fits through somewhere;
//  - through a passage that opens it takes the straight line at top speed, from the nearest place behind it.
// A load that a vehicle has aboard when it dies comes no farther until that one is back.
//
//   const double at_s =
//       earliest_delivery_s(scenario, run.stood, transport, ready_at(...), {.radius_m = 0.8});

#include <cstdint>
#include <optional>
#include <span>

#include "supervisor/geometry/convex_polygon.h"
#include "tests/bench/shift/figures.h"
#include "tests/bench/shift/scenario.h"

namespace stepwright::bench::shift {

// An obstacle on the floor, for a time.
struct Standing {
  geometry::ConvexPolygon area;
  double begin_s = 0.0;
  double end_s = 0.0;
  std::optional<std::uint32_t> vehicle = {};  // that is dead there
  geometry::Point place = {};                 // its reference point
};

struct ReachOptions {
  double radius_m = 0.8;  // no vehicle needs less on each side of its reference point
  double top_speed_m_s = 1.5;
  double step_m = 0.05;  // of the cells looked at; a disc somewhere in a cell counts as fitting there
};

// From where and when on a load can be driven to where it is to be, at best.
struct Ready {
  geometry::Point at;
  double at_s = 0.0;
  std::optional<std::uint32_t> aboard = {};  // of this vehicle, which was dead until then
};

// At its station, picked up as it was released; or aboard of a vehicle that is back, the last time that it
// died with the load.
Ready ready_at(const Scenario& scenario, std::span<const Standing> stood, const Transport& transport,
               const Delivery& delivery);

// Infinite if nobody delivers it before the last change of the floor and none after it.
double earliest_delivery_s(const Scenario& scenario, std::span<const Standing> stood,
                           const Transport& transport, const Ready& ready, const ReachOptions& options);

}  // namespace stepwright::bench::shift
