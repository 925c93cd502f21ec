#pragma once

// States as the search works on them and what operators do to them. A state is its fact bits followed by its
// variables' doubles; derived facts are bits too, worked out after every change of the others.
//
// Thread rule: immutable after construction: any number of searches may share one.
//
//   StateSpace space(ground);
//   std::vector<Word> state = space.initial(), next(space.words());
//   space.applicable(state.data(), operators);
//   if (space.apply(operators[0], state.data(), next.data(), cost)) ...

#include <bit>
#include <span>
#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"
#include "supervisor/pddl/search/space/axiom_evaluator.h"
#include "supervisor/pddl/search/space/finite_domains.h"
#include "supervisor/pddl/search/space/ground_value.h"
#include "supervisor/pddl/search/space/successor_tree.h"

namespace stepwright::pddl {

class StateSpace {
 public:
  explicit StateSpace(const GroundTask& task);

  const GroundTask& task() const { return task_; }
  const FiniteDomains& domains() const { return domains_; }
  std::size_t words() const { return words_; }
  std::size_t fact_words() const { return fact_words_; }
  std::vector<Word> initial() const;

  bool fact(const Word* state, int fact) const { return bit(state, fact); }
  bool literal(const Word* state, int literal) const {
    return bit(state, literal >> 1) == ((literal & 1) == 0);
  }
  double value(const Word* state, int variable) const {
    return std::bit_cast<double>(state[fact_words_ + static_cast<std::size_t>(variable)]);
  }

  bool holds(const Condition& condition, const Word* state) const;
  bool holds(const Comparison& comparison, const Word* state) const {
    return compare(comparison.relation, evaluate(comparison.difference, state));
  }
  bool goal(const Word* state) const { return holds(task_.goal, state); }
  double evaluate(const GroundExpression& expression, const Word* state) const {
    return ground_value(expression, state + fact_words_);
  }

  // The operators whose preconditions hold, in an order that depends on the task only.
  void applicable(const Word* state, std::vector<int>& operators) const;

  // Writes the state after the operator, which must be applicable, and adds what it accumulates to `cost`.
  // False if an effect is undefined there: then the operator cannot be applied after all.
  bool apply(int op, const Word* from, Word* to, double& cost) const;
  bool apply(const GroundOperator& op, const Word* from, Word* to, double& cost) const {
    return apply(static_cast<int>(&op - task_.operators.data()), from, to, cost);
  }

  // Works out the derived facts of a state whose other facts and values are right.
  void derive(Word* state) const {
    if (!task_.axioms.empty()) axioms_.derive(state, [&](const Condition& c) { return holds(c, state); });
  }

 private:
  // Unconditional effect of an operator on one word of facts.
  struct WordChange {
    std::uint32_t word;
    Word keep, set;
  };
  struct OperatorChanges {
    int first_change, last_change;
    bool conditional, numeric, conflicts;  // is there more to do or to check?
  };

  void compile(const GroundOperator& op);
  bool apply_numbers(const GroundEffect& effect, const Word* from, Word* to, double& cost) const;
  bool apply_conditional(const GroundOperator& op, const Word* from, Word* to, double& cost) const;
  bool consistent(const GroundOperator& op, const Word* from) const;
  bool fires(const GroundEffect& effect, const Word* from) const {
    return effect.when.always() || holds(effect.when, from);
  }

  const GroundTask& task_;
  FiniteDomains domains_;
  SuccessorTree tree_;
  AxiomEvaluator axioms_;
  std::size_t fact_words_;
  std::size_t words_;
  std::vector<OperatorChanges> operators_;
  std::vector<WordChange> changes_;
};

}  // namespace stepwright::pddl
