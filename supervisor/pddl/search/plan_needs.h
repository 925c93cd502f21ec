#pragma once

// What the rest of a plan needs of the state that it starts in: the literals that it reads before it makes
// them true itself, and the variables whose values it looks at. Any state that has those lets the rest run as
// it did, at the same cost.
//
// Thread rule: plain values.

#include <vector>

#include "supervisor/pddl/search/state_space.h"

namespace stepwright::pddl {

class PlanNeeds {
 public:
  // What the goal and the metric need, after the plan's last state.
  PlanNeeds(const StateSpace& space, const Word* last);

  // Puts one operator, which is applied in `before`, ahead of the rest.
  void prepend(int op, const Word* before);

  // Ascending.
  std::vector<int> literals() const;
  std::vector<int> variables() const;

 private:
  void need(const Condition& condition, const Word* state);
  void need_all(const Condition& condition, const Word* state);
  void need_variables(const GroundExpression& expression);

  const StateSpace& space_;
  std::vector<bool> literals_, variables_;
};

}  // namespace stepwright::pddl
