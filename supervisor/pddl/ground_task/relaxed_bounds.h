#pragma once

// Bounds over relaxed states: conditions that can hold, and how far an effect can go given what its
// precondition says.
//
// Thread rule: pure functions.

#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

// A relaxed state: literals that can hold, what every variable can be.
struct RelaxedState {
  std::vector<bool> literals;
  std::vector<Interval> values;
};

// False only if the condition holds in no state that the relaxed state stands for.
bool can_hold(const Condition& condition, const RelaxedState& state);

// Interval of the expression where all the conditions hold. For linear expressions the linear comparisons
// among the conditions count: under x + a <= 10 the expression x + a is at most 10, whatever x and a can be.
Interval implied_interval(const GroundExpression& expression, const std::vector<const Condition*>& conditions,
                          const std::vector<Interval>& values);

// A linear expression with what conditions say of it: it is at most each of `upper` and at least minus each
// of `lower`, whatever the variables are. For expressions that are evaluated again and again.
struct BoundedExpression {
  GroundExpression expression;
  std::vector<GroundExpression> upper, lower;
};
BoundedExpression bound_by(GroundExpression expression, const std::vector<const Condition*>& conditions);
Interval evaluate_interval(const BoundedExpression& bounded, const std::vector<Interval>& values);

// The value that the effect gives its variable, as an expression of the state before.
GroundExpression result_of(const NumericEffect& effect);

}  // namespace stepwright::pddl
