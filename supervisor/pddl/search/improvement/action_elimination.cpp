#include "supervisor/pddl/search/improvement/action_elimination.h"

#include "supervisor/pddl/search/control/plan_runner.h"

namespace stepwright::pddl {

std::vector<int> eliminate_actions(const StateSpace& space, std::vector<int> plan, SearchControl& control) {
  PlanRunner runner(space);
  std::vector<int> rest;
  double best = cost_of_plan(space, plan), cost = 0.0;
  for (std::size_t i = 0; i < plan.size();) {
    if (control.check() != StopReason::None) return plan;
    runner.run(plan, i, rest, cost);
    if (comparable(cost) <= comparable(best)) {
      plan.swap(rest);
      best = cost;
    } else {
      ++i;
    }
  }
  return plan;
}

}  // namespace stepwright::pddl
