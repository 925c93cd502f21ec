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
// A derived fact holds if an axiom says so and not otherwise; it is a function of the other facts and the
// variables, and so no part of what tells states apart.
//
// Thread rule: immutable once built.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/ground_task/expression.h"

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

// The derived fact holds where the body does; a fact may have several axioms.
struct GroundAxiom {
  int fact = 0;
  Condition body;
  int layer = 0;  // the body negates derived facts of lower layers only
};

// A finite-domain variable: facts that exclude each other in every reachable state.
struct FactGroup {
  std::vector<int> facts;    // ascending
  bool exactly_one = false;  // one of them always holds; otherwise "none of them" is a value too
};

struct GroundTask {
  const Definition* definition = nullptr;
  std::vector<Atom> facts;  // those from `first_derived` on are derived: no operator has them in its effects
  int first_derived = 0;
  std::vector<GroundAxiom> axioms;  // by layer
  std::vector<FactGroup> groups;    // by first fact; every fact is in exactly one
  std::vector<std::vector<int>>
      exclusive;  // all sets found of facts of which at most one holds at a time; they may overlap
  std::vector<Atom> variables;
  std::vector<Interval> bounds;  // of every variable over all reachable states
  std::vector<GroundOperator> operators;
  std::vector<bool> initial_facts;     // with the derived ones
  std::vector<double> initial_values;  // NaN = undefined
  Condition goal;
  std::optional<std::string>
      unreachable_goal;  // proved by relaxed reachability: each conjunct that cannot hold, and why
  double base_cost = 0.0;
  GroundExpression potential;
  bool maximize = false;
  bool cancelled = false;  // grounding was stopped; the rest is not meaningful
};

model::GroundAction action_of(const GroundTask& task, const GroundOperator& op);

}  // namespace stepwright::pddl
