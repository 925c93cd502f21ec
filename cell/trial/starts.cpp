#include "cell/trial/starts.h"

#include <utility>

#include "cell/binding/ground_actions.h"
#include "supervisor/pddl/plan/simulate.h"
#include "supervisor/pddl/planner/solve.h"

namespace stepwright::trial {
namespace {

std::optional<std::vector<model::GroundAction>> plan_of(const pddl::Task& task,
                                                        std::chrono::milliseconds time) {
  pddl::Options options;
  options.first_only = true;
  options.budget.time = time;
  model::Outcome outcome = pddl::solve(task, options);
  if (!outcome.plan) return std::nullopt;
  return std::move(outcome.plan->actions);
}

}  // namespace

Starts::Starts(const pddl::Task& task, std::chrono::milliseconds time) : task_(task), time_(time) {
  if (auto plan = plan_of(task, time)) goal_plan_ = std::move(*plan);
}

bool Starts::applies(const std::vector<model::GroundAction>& before,
                     const model::GroundAction& action) const {
  model::Plan plan;
  plan.actions = before;
  plan.actions.push_back(action);
  return pddl::state_after(task_, plan).has_value();
}

std::optional<Start> Starts::along_goal(const model::GroundAction& action) const {
  for (std::size_t length = 0; length <= goal_plan_.size(); ++length) {
    Start start;
    start.before.assign(goal_plan_.begin(), goal_plan_.begin() + static_cast<std::ptrdiff_t>(length));
    if (applies(start.before, action)) return start;
  }
  return std::nullopt;
}

std::vector<Start> Starts::of(const pddl::GroundActionInfo& info) {
  std::vector<Start> found;
  if (applies({}, info.action)) {
    found.push_back({});
  } else if (const auto wanted = task_.with_goal(cell_binding::precondition_text(info))) {
    if (auto plan = plan_of(*wanted, time_); plan && applies(*plan, info.action))
      found.push_back({std::move(*plan)});
  }
  if (auto other = along_goal(info.action)) {
    if (found.empty() || found.front().before != other->before) found.push_back(std::move(*other));
  }
  return found;
}

}  // namespace stepwright::trial
