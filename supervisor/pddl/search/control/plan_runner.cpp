#include "supervisor/pddl/search/control/plan_runner.h"

#include <utility>

namespace stepwright::pddl {

void PlanRunner::run(const std::vector<int>& plan, std::size_t left_out, std::vector<int>& applied,
                     double& cost) {
  state_ = initial_;
  applied.clear();
  cost = 0.0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i == left_out) continue;
    const auto& op = space_.task().operators[static_cast<std::size_t>(plan[i])];
    double step = 0.0;
    if (!space_.holds(op.precondition, state_.data())) continue;
    if (!space_.apply(plan[i], state_.data(), next_.data(), step)) continue;
    cost = snap(cost + step);
    state_.swap(next_);
    applied.push_back(plan[i]);
  }
  cost =
      space_.goal(state_.data()) ? cost + space_.evaluate(space_.task().potential, state_.data()) : kInfinity;
}

double cost_of_plan(const StateSpace& space, const std::vector<int>& plan) {
  std::vector<int> applied;
  double cost = 0.0;
  PlanRunner(space).run(plan, plan.size(), applied, cost);
  return applied.size() == plan.size() ? cost : kInfinity;
}

bool offer_plan(const StateSpace& space, SearchControl& control, std::vector<int> plan) {
  const double cost = cost_of_plan(space, plan);
  return cost < kInfinity && control.offer(std::move(plan), cost);
}

}  // namespace stepwright::pddl
