#pragma once

// From a checked definition to the numbered task of the search.
//
// Thread rule: pure function.

#include <functional>

#include "supervisor/pddl/grounding/ground_task.h"

namespace stepwright::pddl {

// `stop` is asked now and then; when it answers true the result is marked cancelled. The definition must
// outlive the task.
GroundTask ground_task(const Definition& definition, const std::function<bool()>& stop);

}  // namespace stepwright::pddl
