#pragma once

// The baseline of relaxed reachability: every operator is looked at in every round until nothing changes.

#include <functional>
#include <vector>

#include "supervisor/pddl/grounding/raw_task.h"

namespace stepwright::pddl::baseline {

// Nothing if `stop` answered true.
bool explore(RawTask& raw, RelaxedState start, const std::function<bool()>& stop);

}  // namespace stepwright::pddl::baseline
