#pragma once

// Truth of a formula as far as static facts and the objects bound so far decide it, in three-valued logic:
// quantifiers need not be multiplied out where it is decided already.
//
// Thread rule: pure function.

#include <optional>

#include "supervisor/pddl/lifted/evaluate.h"

namespace stepwright::pddl {

// Nothing if it is open: facts that change, comparisons and quantifiers are, and so is what has a variable
// that is not bound.
std::optional<bool> static_truth(const Definition& definition, const Formula& formula, const Binding& binding,
                                 const LiftedState& initial);

}  // namespace stepwright::pddl
