#pragma once

// A condition as alternatives, each a conjunction with the variables that its "exists" bind: "some block
// between" becomes a join instead of a disjunction over all blocks.
//
// Thread rule: pure functions. What they answer points into the formula, which must outlive it.
//
//   for (const Alternative& option : alternatives(axiom.body)) ...

#include <set>
#include <vector>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

struct Alternative {
  std::vector<Typed> variables;  // of the quantifiers that were lifted out
  std::vector<const Formula*> conjuncts;
};

// Variables can be lifted out because every quantifier of a schema has slots of its own. What would give too
// many alternatives stays one condition.
std::vector<Alternative> alternatives(const Formula& formula);

// Adds the slots that the formula reads, those of its own quantifiers among them.
void collect_slots(const Formula& formula, std::set<int>& slots);

}  // namespace stepwright::pddl
