#pragma once

// A bound on what all vehicles drive together where branch and bound is out of reach: every stop is driven to
// from somewhere. Two trips that no vehicle can have aboard at once are never in between one another.

#include <cstdint>

#include "supervisor/fleet/allocation/internal/trip_model.h"

namespace stepwright::fleet::internal {

// No routes drive less. The least assignment of a place to come from to every stop (Kuhn 1955), in time that
// grows with the third power of the stops; with more than 500 stops the sum of the shortest ways to each.
std::int64_t least_travel_ms(const TripModel& model);

// No routes have a smaller value: travel as above, and for makespan and tardiness what single trips need and
// what falls to each vehicle if all share the work.
std::int64_t least_value(const TripModel& model);

}  // namespace stepwright::fleet::internal
