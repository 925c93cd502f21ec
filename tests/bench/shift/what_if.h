#pragma once

// A shift without a plant: every vehicle keeps the earliest times of its schedule. For questions of the kind
// "how many vehicles", and, driven by first-come-first-served locks instead of schedules, as a baseline.
//
//   const ShiftFigures twelve = run_timed(scenario, fleet, 12);

#include "tests/bench/shift/plant_run.h"

namespace stepwright::bench::shift {

// Transports of the scenario, without its pauses, blockages and breakdowns. `fleet` has at least so many
// vehicles; what it has planned is used again.
ShiftFigures run_timed(const Scenario& scenario, Fleet& fleet, std::uint32_t vehicles);

struct LockFigures {
  ShiftFigures figures;
  std::uint32_t deadlocks = 0;  // circles of vehicles that wait for each other; one of each is carried home
};

// The same vehicles, routes and dispatching; whoever comes first locks the next polygon if no other vehicle
// holds one that overlaps it, and nobody looks farther ahead.
LockFigures run_with_locks(const Scenario& scenario, Fleet& fleet, std::uint32_t vehicles);

}  // namespace stepwright::bench::shift
