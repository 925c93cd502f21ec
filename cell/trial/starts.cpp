#include "cell/trial/starts.h"

#include <optional>
#include <utility>

#include "cell/binding/ground_actions.h"
#include "supervisor/pddl/plan/simulate.h"

namespace stepwright::trial {
namespace {

std::optional<std::vector<model::GroundAction>> plan_of(const pddl::Task& task,
                                                        const pddl::Options& options) {
  model::Outcome outcome = pddl::solve(task, options);
  if (!outcome.plan) return std::nullopt;
  return std::move(outcome.plan->actions);
}

}  // namespace

Starts::Starts(const pddl::Task& task, const pddl::Options& own, std::chrono::milliseconds time)
    : task_(task), time_(time) {
  if (auto plan = plan_of(task, own)) goal_plan_ = std::move(*plan);
}

bool Starts::applies(const std::vector<model::GroundAction>& before,
                     const model::GroundAction& action) const {
  model::Plan plan;
  plan.actions = before;
  plan.actions.push_back(action);
  return pddl::state_after(task_, plan).has_value();
}

Start Starts::after(std::size_t actions) const {
  return {{goal_plan_.begin(), goal_plan_.begin() + static_cast<std::ptrdiff_t>(actions)}};
}

std::vector<Start> Starts::along_goal(const model::GroundAction& action) const {
  std::vector<Start> found;
  for (std::size_t i = 0; i < goal_plan_.size(); ++i)
    if (goal_plan_[i] == action) found.push_back(after(i));
  for (std::size_t i = 0; found.empty() && i <= goal_plan_.size(); ++i)
    if (Start start = after(i); applies(start.before, action)) found.push_back(std::move(start));
  return found;
}

std::vector<Start> Starts::of(const pddl::GroundActionInfo& info) {
  std::vector<Start> found;
  if (applies({}, info.action)) {
    found.push_back({});
  } else if (const auto wanted = task_.with_goal(cell_binding::precondition_text(info))) {
    pddl::Options options;
    options.first_only = true;
    options.budget.time = time_;
    if (auto plan = plan_of(*wanted, options); plan && applies(*plan, info.action))
      found.push_back({std::move(*plan)});
  }
  for (Start& other : along_goal(info.action))
    if (found.empty() || found.front().before != other.before) found.push_back(std::move(other));
  return found;
}

}  // namespace stepwright::trial
