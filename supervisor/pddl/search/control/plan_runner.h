#pragma once

// Executes plans from the initial state, to know what they cost. Searches offer what they find through here:
// a node may still have the cost of an earlier way to a state before it, a plan has that of its own way.
//
// Thread rule: one search, one PlanRunner; the functions are pure but for the control.

#include <vector>

#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

class PlanRunner {
 public:
  explicit PlanRunner(const StateSpace& space)
      : space_(space), initial_(space.initial()), next_(space.words()) {}

  // The operators of the plan that can be applied when `left_out` is not; every one, if none is. `cost`: with
  // the potential, infinite if they do not lead to the goal.
  void run(const std::vector<int>& plan, std::size_t left_out, std::vector<int>& applied, double& cost);

 private:
  const StateSpace& space_;
  std::vector<Word> initial_, state_, next_;
};

// The cost of the plan from the initial state, with the potential; infinite if it does not lead to the goal.
double cost_of_plan(const StateSpace& space, const std::vector<int>& plan);

// True if the plan leads to the goal and is better than the control's best, which it then is.
bool offer_plan(const StateSpace& space, SearchControl& control, std::vector<int> plan);

}  // namespace stepwright::pddl
