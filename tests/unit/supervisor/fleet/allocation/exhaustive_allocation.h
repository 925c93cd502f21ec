#pragma once

// The value of the best allocation by trying all of them: every division, every vehicle for every trip, every
// order of stops, times by repeated relaxation. It shares no code with the allocator.

#include <cstdint>
#include <optional>

#include "supervisor/fleet/allocation/allocation_answer.h"

namespace stepwright::fleet {

// Nothing: there is none.
std::optional<std::int64_t> best_by_enumeration(const AllocationProblem& problem);

// The parts of the problem that the conflict names, less the `without`-th of them, counted through
// transports, constraints, vehicles, orders, routes.
inline constexpr std::size_t kKeepAll = static_cast<std::size_t>(-1);
AllocationProblem reduced_to(const AllocationConflict& conflict, const AllocationProblem& problem,
                             std::size_t without = kKeepAll);

}  // namespace stepwright::fleet
