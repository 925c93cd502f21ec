#pragma once

// Fluents that operators would change and that never have a value to be changed: why tasks have no plan
// though everything seems to be there.
//
// Thread rule: pure function.

#include <string>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

// "(fuel t2) never gets a value, so that no action can change it": a sentence with the first of them; empty
// if there is none.
std::string never_valued(const GroundTask& task);

}  // namespace stepwright::pddl
