#pragma once

// Integer fluents, which start as an integer and which every change keeps one, and expressions that are
// integers, too.
//
// Thread rule: pure function.

#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

std::vector<bool> integer_variables(const GroundTask& task);

// Is the expression always an integer, if the variables that are marked are?
bool is_integer(const GroundExpression& expression, const std::vector<bool>& integer);

}  // namespace stepwright::pddl
