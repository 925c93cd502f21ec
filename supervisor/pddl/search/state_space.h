#pragma once

// States as packed words and what operators do to them. A state is its fact bits followed by its variables'
// doubles.
//
// Thread rule: immutable after construction, except for the scratch that axioms need: one search, one
// StateSpace.

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/pddl/grounding/ground_task.h"
#include "supervisor/pddl/search/axiom_evaluator.h"

namespace stepwright::pddl {

class StateSpace {
 public:
  explicit StateSpace(const GroundTask& task);

  const GroundTask& task() const { return task_; }
  std::size_t words() const { return words_; }
  std::vector<Word> initial() const;

  bool fact(const Word* state, int fact) const { return (state[fact >> 6] >> (fact & 63) & 1) != 0; }
  bool literal(const Word* state, int literal) const {
    return fact(state, literal / 2) == (literal % 2 == 0);
  }
  double value(const Word* state, int variable) const {
    return std::bit_cast<double>(state[fact_words_ + static_cast<std::size_t>(variable)]);
  }

  bool holds(const Condition& condition, const Word* state) const;
  bool goal(const Word* state) const { return holds(task_.goal, state); }
  double evaluate(const GroundExpression& expression, const Word* state) const {
    return evaluate_with(expression, [&](int variable) { return value(state, variable); });
  }

  // The operators whose preconditions hold, ascending.
  void applicable(const Word* state, std::vector<int>& operators) const;

  // Writes the state after the operator, which must be applicable, and adds what it accumulates to `cost`.
  // False if an effect is undefined there: then the operator cannot be applied after all.
  bool apply(const GroundOperator& op, const Word* from, Word* to, double& cost) const;

 private:
  bool apply_effect(const GroundEffect& effect, const Word* from, Word* to, double& cost) const;
  bool consistent(const GroundOperator& op, const Word* from) const;

  void derive(Word* state) const {
    if (!task_.axioms.empty()) axioms_.derive(state, [&](const Condition& c) { return holds(c, state); });
  }

  const GroundTask& task_;
  mutable AxiomEvaluator axioms_;  // its scratch
  std::size_t fact_words_;
  std::size_t words_;
  std::vector<std::vector<int>> by_literal_;  // operators under one literal of their precondition
  std::vector<int> without_literal_;
};

}  // namespace stepwright::pddl
