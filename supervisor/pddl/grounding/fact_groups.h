#pragma once

// From overlapping invariants to finite-domain variables: a cover in which every fact is in one group.
//
// Thread rule: pure function.

#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

// The largest set first, then the largest of what is left of the others (Helmert 2009, section 6); a fact
// that no set covers is a group of its own. `sets` hold facts below `facts`, ascending; a set loses its
// `exactly_one` with the first fact that goes to another.
std::vector<FactGroup> choose_groups(std::vector<FactGroup> sets, std::size_t facts);

}  // namespace stepwright::pddl
