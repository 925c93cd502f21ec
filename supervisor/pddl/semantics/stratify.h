#pragma once

// The order in which axioms are evaluated (Thiebaux, Hoffmann, Nebel 2005, "In defense of PDDL axioms"): a
// derived predicate may depend on itself, but not on its own negation.
//
// Thread rule: pure function.

#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/syntax/notation.h"

namespace stepwright::pddl {

// Sets `layer` and `changes` of the derived predicates and sorts the axioms by layer. Reports P0116 at every
// negated use that closes a cycle. Needs checked axioms.
void stratify(Definition& definition, Reporter& reporter);

}  // namespace stepwright::pddl
