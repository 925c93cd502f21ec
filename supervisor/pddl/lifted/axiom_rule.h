#pragma once

// An axiom as a join: the atoms whose facts bind its variables, and the tests of what they bound.
//
// Thread rule: plain values, pure functions. The rules point into the definition, which must outlive them.

#include <vector>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

// A condition that is judged as soon as these slots are bound.
struct AxiomTest {
  const Formula* formula = nullptr;
  std::vector<int> slots;
};

struct AxiomRule {
  const Axiom* axiom = nullptr;
  std::vector<Typed> variables;  // parameters, and what "exists" binds
  std::vector<const Call*> atoms;
  std::vector<AxiomTest> tests;
  // A test reads facts that the same layer derives: a fact of theirs may make it hold later.
  bool tests_grow = false;
};

// The rules of the axioms [first, last), which are of one layer: one for each alternative of a body.
std::vector<AxiomRule> axiom_rules(const Definition& definition, std::size_t first, std::size_t last);

}  // namespace stepwright::pddl
