#pragma once

// Places and angles of a sequence that its arms reach for certain. solve() only meets outer bounds of the
// reach; here points of what the bounds leave are tried, and each is asked of the arms themselves
// (exact_reach.h). What is found is true; where nothing is found there may be something all the same.
//
// A function without state; any thread.
//
//   if (reached(cell, sequence)) ...         // within reach, as far as no body is in the way

#include <cstddef>
#include <optional>
#include <span>

#include "supervisor/tamp/intervals/cause/witness.h"

namespace stepwright::tamp {

// After so many questions nothing is found. Requires a sequence that validate() accepts.
std::optional<Witness> reached(const WorkCell& cell, std::span<const Action> sequence,
                               std::size_t most_questions = 2'000);

}  // namespace stepwright::tamp
