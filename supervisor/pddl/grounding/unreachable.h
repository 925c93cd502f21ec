#pragma once

// Reason why a goal cannot be reached, as relaxed reachability saw it.
//
// Thread rule: pure function.

#include <string>

#include "supervisor/pddl/grounding/raw_task.h"

namespace stepwright::pddl {

// "problem.pddl:12:5: P0501: the goal (at k1 p9) cannot be reached: none of the actions that could make (at
// k1 p9) true (unload) can ever do so". Requires a goal that cannot hold in raw.reachable.
std::string why_unreachable(const RawTask& raw, const RawGoal& goal);

}  // namespace stepwright::pddl
