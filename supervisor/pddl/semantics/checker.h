#pragma once

// Resolves names and checks types: from the parsed texts to a Definition.
//
// Thread rule: pure functions. Reports every error; the result is meaningful only if the reporter has no
// error.

#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/syntax/notation.h"
#include "supervisor/pddl/syntax/parser.h"

namespace stepwright::pddl {

Definition check_task(ParsedDomain domain, ParsedProblem problem, Reporter& reporter);

// Resolves a goal against a checked definition and puts it there.
void check_goal(Formula goal, Definition& definition, Reporter& reporter);

}  // namespace stepwright::pddl
