#pragma once

// The smallest part of a sequence's constraints that still conflicts: each is left out in turn, and stays out
// if what remains is still infeasible. A function without state; any thread.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/tamp/intervals/network/network.h"

namespace stepwright::tamp {

struct ConflictSet {
  std::vector<ConstraintId> ids;  // ascending
  std::vector<Constraint> constraints;
  bool irreducible = false;
};

// Nothing if the sequence is not provably infeasible.
std::optional<ConflictSet> conflict_of(const WorkCell& cell, std::span<const Action> sequence,
                                       std::size_t most_nodes);

}  // namespace stepwright::tamp
