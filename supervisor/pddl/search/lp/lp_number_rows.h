#pragma once

// Balances of numbers: what the operators add to an expression at most covers its way to what the goal wants
// or, along the whole plan, to the least value that it has in any reachable state.
//
// Thread rule: pure function.

#include <functional>
#include <vector>

#include "supervisor/pddl/search/lp/lp_program.h"
#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

struct NumberRow {
  GroundExpression expression;  // linear, without a constant
  double least = 0.0;           // of its value after every plan
  bool integer = false;         // its values
  LpRow row;                    // what each operator adds at most
};

// About the expressions of the goal and of preconditions, and about single fluents with known bounds. When
// `stop` says so, only those that are ready.
std::vector<NumberRow> number_rows(const StateSpace& space, const std::function<bool()>& stop);

}  // namespace stepwright::pddl
