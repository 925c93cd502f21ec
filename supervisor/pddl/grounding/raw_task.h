#pragma once

// What grounding works on before unreachable and irrelevant parts are left out.
//
// Thread rule: plain values.

#include <vector>

#include "supervisor/pddl/grounding/reachability.h"

namespace stepwright::pddl {

struct RawGoal {
  Condition condition;
  const Formula* formula = nullptr;
};

struct RawTask {
  const Definition* definition = nullptr;
  std::vector<Atom> facts;
  std::vector<Atom> variables;
  std::vector<bool> initial_facts;
  std::vector<double> initial_values;  // NaN = undefined
  std::vector<GroundOperator> operators;
  std::vector<RawGoal> goals;  // one per conjunct
  GroundExpression metric;     // to be minimized; empty without one
  Reachable reachable;
};

// Numbers what matters, folds what is constant, separates the accumulated cost from the variables.
GroundTask simplify(RawTask raw);

}  // namespace stepwright::pddl
