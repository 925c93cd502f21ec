#pragma once

// Relaxed reachability over all operators: which literals can ever hold, between which ends every variable
// stays, which operators can ever be applied. Deletes are ignored and variables are intervals, so what is
// unreachable here is unreachable.
//
// Thread rule: pure function.

#include <functional>
#include <vector>

#include "supervisor/pddl/grounding/relaxed_bounds.h"

namespace stepwright::pddl {

struct Reachable {
  RelaxedState state;
  std::vector<bool> operators;
  bool stopped = false;
};

// `start`: the initial state as points, with every derived fact's negation: that they may cease to hold is
// not followed up. Ends because intervals that grow for long are widened to the end that the preconditions
// imply, or to kInfinity.
Reachable explore(const std::vector<GroundOperator>& operators, const std::vector<GroundAxiom>& axioms,
                  RelaxedState start, const std::function<bool()>& stop);

}  // namespace stepwright::pddl
