#pragma once

// The derived facts of a state: the least fixpoint of the axioms, layer by layer.
//
// Thread rule: pure function.

#include "supervisor/pddl/lifted/lifted_state.h"

namespace stepwright::pddl {

// Replaces the state's derived facts by those that follow from the rest of it.
void derive(const Definition& definition, LiftedState& state);

}  // namespace stepwright::pddl
