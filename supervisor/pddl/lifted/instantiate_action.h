#pragma once

// From schemas to the readable ground form of GroundActionInfo: quantifiers expanded, negations pushed
// inwards, what never changes decided.
//
// Thread rule: one object per use; it only reads the definition.

#include <vector>

#include "supervisor/pddl/ground_action.h"
#include "supervisor/pddl/lifted/executor.h"

namespace stepwright::pddl {

class ActionInstantiator {
 public:
  explicit ActionInstantiator(const Definition& definition)
      : definition_(definition), initial_(initial_state(definition)) {}

  // Appends what the formula requires; an impossible formula gives an Any without parts.
  void conjuncts(const Formula& formula, Binding& binding, std::vector<Requirement>& list);

  // Appends the changes that the effect makes under the conditions `when`.
  void changes(const Effect& effect, Binding& binding, const std::vector<Requirement>& when,
               std::vector<Change>& list);

 private:
  NumericNode number(const Expression& expression, const Binding& binding) const;
  Requirement any(const Formula& formula, Binding& binding, bool positive);
  void collect(const Formula& formula, Binding& binding, bool positive, std::vector<Requirement>& list);
  void collect_parts(const Formula& formula, Binding& binding, bool positive, std::vector<Requirement>& list);
  void atom(const Formula& formula, const Binding& binding, bool positive, std::vector<Requirement>& list);
  void comparison(const Formula& formula, Binding& binding, bool positive, std::vector<Requirement>& list);

  const Definition& definition_;
  LiftedState initial_;
};

}  // namespace stepwright::pddl
