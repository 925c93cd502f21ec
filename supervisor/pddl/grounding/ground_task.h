#pragma once

// The task as the search sees it: numbered facts and numeric variables, operators over them, nothing that
// cannot change and nothing that decides nothing.
//
// Facts are bits. A literal is 2 x fact for "holds" and 2 x fact + 1 for "does not hold". Fluents that only
// the metric reads and that are only increased or decreased are no variables: their weighted amounts are the
// cost of an operator ("accumulated" cost). What else the metric reads is its potential, a function of the
// state. So metric = base + accumulated + potential(state), always minimized: a metric to be maximized is
// negated.
//
// Thread rule: immutable once built.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/grounding/expression.h"
#include "supervisor/pddl/syntax/ast.h"

namespace stepwright::pddl {

struct Comparison {
  GroundExpression difference;  // compared with zero
  Relation relation{};
};

// All literals, all comparisons, and of every choice at least one option.
struct Condition {
  std::vector<int> literals;
  std::vector<Comparison> comparisons;
  std::vector<std::vector<Condition>> choices;
  bool impossible = false;

  bool always() const { return !impossible && literals.empty() && comparisons.empty() && choices.empty(); }
};

struct NumericEffect {
  int variable = 0;
  ChangeKind kind{};
  GroundExpression amount;
};

// Changes that happen together, if `when` holds before the action.
struct GroundEffect {
  Condition when;
  std::vector<int> adds;     // facts
  std::vector<int> deletes;  // facts; a fact that is added too stays
  std::vector<NumericEffect> numeric;
  GroundExpression cost;  // weighted sum of the accumulated fluents' changes
};

struct GroundOperator {
  int action = 0;
  std::vector<int> arguments;
  Condition precondition;
  std::vector<GroundEffect> effects;
  Interval cost;              // of one application in any reachable state
  bool may_conflict = false;  // two effects may change one variable in ways that exclude each other
};

struct GroundTask {
  const Definition* definition = nullptr;
  std::vector<Atom> facts;
  std::vector<Atom> variables;
  std::vector<Interval> bounds;  // of every variable over all reachable states
  std::vector<GroundOperator> operators;
  std::vector<bool> initial_facts;
  std::vector<double> initial_values;  // NaN = undefined
  Condition goal;
  std::optional<std::string>
      unreachable_goal;  // proved by relaxed reachability: text of the conjunct and why
  double base_cost = 0.0;
  GroundExpression potential;
  bool maximize = false;
  bool cancelled = false;  // grounding was stopped; the rest is not meaningful
};

model::GroundAction action_of(const GroundTask& task, const GroundOperator& op);

}  // namespace stepwright::pddl
