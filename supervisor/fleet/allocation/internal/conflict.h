#pragma once

// Conflict that leaves no allocation: parts of the problem, made minimal by leaving out one after the other
// (deletion filter, Chinneck and Dravnieks 1991), with branch and bound as the judge.
//
// One thread at a time, as the limits are.

#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/fleet/allocation/allocation_answer.h"
#include "supervisor/fleet/allocation/internal/limits.h"
#include "supervisor/fleet/allocation/internal/selection.h"
#include "supervisor/fleet/allocation/internal/trip_model.h"

namespace stepwright::fleet::internal {

enum class Judgement : std::uint8_t { Possible, Impossible, Unknown };

// Whether what is selected can be carried. Unknown: too many trips, or the limits ended it.
Judgement judge(const AllocationProblem& problem, const Selection& selection, Ways ways,
                const Limits& limits);

// A part of the problem, small enough to be judged, that cannot be carried even if vehicles may drive by way
// of others: then nor can the whole. `missing`: transports that a search found no place for.
std::optional<Selection> impossible_part(const AllocationProblem& problem,
                                         const std::vector<std::uint32_t>& missing, const Limits& limits);

// Requires a selection that is impossible as its ways are given.
AllocationConflict conflict_within(const AllocationProblem& problem, Selection selection,
                                   const Limits& limits);

}  // namespace stepwright::fleet::internal
