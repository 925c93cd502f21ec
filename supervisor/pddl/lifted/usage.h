#pragma once

// Usage of functions: which of them only the metric reads.
//
// Thread rule: pure functions.

#include <set>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

// The functions that no condition, no axiom, no goal and no amount of an effect reads: only the metric can,
// so that they count but do not decide anything.
std::set<int> metric_only_functions(const Definition& definition);

}  // namespace stepwright::pddl
