#pragma once

// Which fluents are always integers: they start as one, and every change keeps them one. Which expressions
// are.
//
// Thread rule: pure function.

#include <vector>

#include "supervisor/pddl/grounding/ground_task.h"

namespace stepwright::pddl {

std::vector<bool> integer_variables(const GroundTask& task);

// Is the expression always an integer, if the variables that are marked are?
bool is_integer(const GroundExpression& expression, const std::vector<bool>& integer);

}  // namespace stepwright::pddl
