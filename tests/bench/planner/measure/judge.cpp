#include "tests/bench/planner/measure/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

#include "supervisor/pddl/plan/validate.h"

namespace stepwright::bench {

Judgement judge(const pddl::Task& task, std::vector<model::GroundAction> actions) {
  pddl::PlanText plan;
  plan.actions = std::move(actions);
  plan.lines.resize(plan.actions.size());
  std::iota(plan.lines.begin(), plan.lines.end(), 1U);
  const pddl::Validation validation = pddl::validate(task, plan, pddl::KeepStates::Last);
  if (validation.valid) return {"", validation.cost()};
  if (validation.failed_step > 0) {
    return {fmt::format("step {}: {} does not hold ({})", validation.failed_step, validation.failed_condition,
                        validation.failed_values),
            0.0};
  }
  for (const pddl::GoalStatus& goal : validation.goals) {
    if (!goal.met) return {"the goal " + goal.text + " does not hold at the end", 0.0};
  }
  return {result::to_string(validation.diagnostics), 0.0};
}

model::GroundAction action_of(const std::string& text) {
  std::string plain = text;
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
  std::istringstream words(plain);
  model::GroundAction action;
  words >> action.name;
  for (std::string word; words >> word;) action.arguments.push_back(word);
  return action;
}

}  // namespace stepwright::bench
