#pragma once

// Grounding as it was: enumeration of bindings, then relaxed reachability in rounds. The baseline of the
// benchmark and the oracle of the unit tests.

#include <functional>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl::baseline {

GroundTask ground_by_enumeration(const Definition& definition, const std::function<bool()>& stop);

}  // namespace stepwright::pddl::baseline
