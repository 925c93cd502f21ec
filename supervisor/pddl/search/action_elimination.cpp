#include "supervisor/pddl/search/action_elimination.h"

namespace stepwright::pddl {
namespace {

// Executes plans on reused memory.
class Runner {
 public:
  explicit Runner(const StateSpace& space) : space_(space), initial_(space.initial()), next_(space.words()) {}

  // The operators of the plan that can be applied when `left_out` is not; every one, if none is. Sets `cost`.
  void run(const std::vector<int>& plan, std::size_t left_out, std::vector<int>& applied, double& cost) {
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
    cost = space_.goal(state_.data()) ? cost + space_.evaluate(space_.task().potential, state_.data())
                                      : kInfinity;
  }

 private:
  const StateSpace& space_;
  std::vector<Word> initial_, state_, next_;
};

}  // namespace

double cost_of_plan(const StateSpace& space, const std::vector<int>& plan) {
  std::vector<int> applied;
  double cost = 0.0;
  Runner(space).run(plan, plan.size(), applied, cost);
  return applied.size() == plan.size() ? cost : kInfinity;
}

std::vector<int> eliminate_actions(const StateSpace& space, std::vector<int> plan, SearchControl& control) {
  Runner runner(space);
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
