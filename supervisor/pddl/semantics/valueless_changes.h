#pragma once

// Changes of fluents that never have a value: what increases, decreases or scales one cannot be executed.
//
// Thread rule: pure function.

#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/syntax/notation.h"

namespace stepwright::pddl {

// Warns (P0118) at the first such change of every function that has no value for any objects at first and
// that no action assigns. Needs checked actions and the initial fluents.
void warn_of_valueless_changes(const Definition& definition, Reporter& reporter);

}  // namespace stepwright::pddl
