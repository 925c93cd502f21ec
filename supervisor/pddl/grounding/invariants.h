#pragma once

// Mutually exclusive facts, found by synthesis: lifted candidates are guessed from the predicates, checked
// for balance and refined by atoms that a failing operator deletes (Helmert 2009). The check runs over the
// ground operators that can be reached, so that static preconditions, equal objects and conditional effects
// count exactly as the search will meet them; one candidate can hold for some objects and not for others.
//
// Thread rule: pure function.

#include <functional>
#include <vector>

#include "supervisor/pddl/grounding/raw_task.h"

namespace stepwright::pddl {

// At most one of the facts holds in any reachable state.
struct Invariant {
  std::vector<int> facts;    // ascending; only facts that may hold
  bool exactly_one = false;  // and one of them always does
};

// Sets of two and more facts; a fact can be in several. Gives up refining, never correctness, when a task has
// very many candidates or `stop` answers true.
std::vector<Invariant> find_invariants(const RawTask& raw, const std::function<bool()>& stop);

}  // namespace stepwright::pddl
