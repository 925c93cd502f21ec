#pragma once

// Emptiness of formulas in progress: the states that any infinite word satisfies. Private to this library.
//
// A node is a set of obligations that must hold together; an edge settles each Until of the set or takes it
// along. A word exists where a cycle settles every Until that it takes along. Source: P. Gastin, D. Oddoux,
// Fast LTL to Buechi Automata Translation, CAV 2001.

#include <optional>
#include <vector>

#include "supervisor/ltl/automaton/progression.h"

namespace stepwright::ltl {

// In the order of `states`. Nothing, if more than `most_edges` edges, 64 Untils, or 2,000 obligations at once
// would be needed.
std::optional<std::vector<bool>> satisfiable(Progression& progression,
                                             const std::vector<Progression::State>& states,
                                             std::size_t most_edges);

}  // namespace stepwright::ltl
