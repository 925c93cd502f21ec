#pragma once

// Rule of a join, made of an action or an axiom: its variables, the positive atoms that must hold, and the
// conditions that are decided once their variables are bound.
//
// Thread rule: plain values, pure functions. The rules point into the definition, which must outlive them.

#include <vector>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

struct JoinAtom {
  int predicate = 0;
  const std::vector<Term>* terms = nullptr;
  bool dynamic = false;  // actions can make it true later
};

// A condition over objects and static facts.
struct JoinFilter {
  const Formula* formula = nullptr;
  std::vector<int> slots;
  bool holds = true;  // false: the condition must not hold
};

struct JoinRule {
  int action = -1;  // or an axiom:
  int axiom = -1;
  std::vector<Typed> variables;           // parameters, and for axioms what "exists" binds
  std::vector<const Formula*> conjuncts;  // the whole condition, as far as an alternative is not chosen
  std::vector<const Formula*> ruled_out;  // actions: alternatives that other rules are about
  std::vector<JoinAtom> atoms;            // of the conjuncts
  std::vector<JoinFilter> filters;        // of the conjuncts
  std::vector<int> witnesses;             // slots that "exists" binds and nothing reads: one object will do
  int slots = 0;
};

// For an action one rule, or one for every alternative of a disjunction that static facts decide ("the next
// cell up or down"), so that these facts are joined and no binding is found twice; for an axiom one for every
// alternative of its body, with its quantified variables bound by the join, so that "some block between" is a
// join and not a disjunction over all blocks.
std::vector<JoinRule> join_rules(const Definition& definition);

}  // namespace stepwright::pddl
