#pragma once

// Conditions and expressions evaluated on the schemas themselves, without grounding.
//
// Thread rule: pure functions. Invariant: everything comes from a checked definition, so every index is
// resolved; a binding has a place for every slot.

#include <functional>
#include <optional>

#include "supervisor/pddl/definition/text.h"
#include "supervisor/pddl/lifted/lifted_state.h"

namespace stepwright::pddl {

// The object that the term stands for; -1 for a variable that is not bound.
int object_of(const Term& term, const Binding& binding);

Atom ground(const Call& call, const Binding& binding);

// Nothing if a fluent has no value or a divisor is zero.
std::optional<double> evaluate(const Expression& expression, const Binding& binding,
                               const LiftedState& state);

// A comparison with an undefined side does not hold, and neither does its negation: in PDDL 2.1 (Fox, Long
// 2003, section 6) a fluent without a value is undefined, not some number, so an action that asks for it is
// not applicable, however it asks. The planner's grounded conditions, negations pushed inwards, say the same.
bool holds(const Definition& definition, const Formula& formula, Binding& binding, const LiftedState& state);

// Calls `visit` for every combination of objects for the variables; stops when it answers false.
void for_each_binding(const Definition& definition, const std::vector<Typed>& variables, Binding& binding,
                      const std::function<bool()>& visit);

// The first conjunct that does not hold, as ground text, and the values it met; empty text if all hold.
struct Violation {
  std::string condition;
  std::string values;
};
Violation first_violation(const Definition& definition, const Formula& formula, Binding& binding,
                          const LiftedState& state);

}  // namespace stepwright::pddl
