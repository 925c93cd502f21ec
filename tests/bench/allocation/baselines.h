#pragma once

// Baselines of the allocation: two rules of thumb for a fleet without a planner, on the same trips and judged
// by the same times. Pure; any thread.

#include <cstdint>
#include <optional>

#include "supervisor/fleet/allocation/allocation_answer.h"

namespace stepwright::bench::allocation {

// The vehicle that is free first takes the trip whose pick-up it reaches first, and sets it down at once.
// Nothing if that breaks a constraint.
std::optional<fleet::AllocationAnswer> nearest_vehicle(const fleet::AllocationProblem& problem);

// Trips in the order of the problem, each where it makes the objective grow least. Nothing if one has no
// place, or a constraint between trips is broken.
std::optional<fleet::AllocationAnswer> plain_insertion(const fleet::AllocationProblem& problem);

}  // namespace stepwright::bench::allocation
