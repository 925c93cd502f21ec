#pragma once

// Which fluents are always integers: they start as one, and every change keeps them one.
//
// Thread rule: pure function.

#include <vector>

#include "supervisor/pddl/grounding/ground_task.h"

namespace stepwright::pddl {

std::vector<bool> integer_variables(const GroundTask& task);

}  // namespace stepwright::pddl
