#include "supervisor/pddl/plan/simulate.h"

#include "supervisor/pddl/definition/text.h"
#include "supervisor/pddl/lifted/executor.h"

namespace stepwright::pddl {
namespace {

// Fails if the metric has no value in a state.
result::Result<double> cost_of(const Definition& definition, const Executor& executor, std::size_t step) {
  const auto cost = executor.cost();
  if (cost) return *cost;
  return result::fail("P0309", {"plan", 0, 0},
                      "the metric " + print(definition, definition.metric->expression) +
                          " is undefined after step " + std::to_string(step),
                      kUndefinedMetricHint);
}

// Executes the plan; `visit` hears of the executor before every step and at the end.
template <typename Visit>
result::Result<void> execute(const Task& task, const model::Plan& plan, const Visit& visit) {
  const Definition& definition = task.definition();
  Executor executor(definition, initial_state(definition));
  for (std::size_t step = 0; step < plan.actions.size(); ++step) {
    visit(executor);
    if (auto failure = executor.step(plan.actions[step])) {
      return result::fail(failure->code, {"plan", 0, 0},
                          "step " + std::to_string(step + 1) + " " + model::to_string(plan.actions[step]) +
                              ": " + failure->message,
                          failure->hint);
    }
  }
  visit(executor);
  auto cost = cost_of(definition, executor, plan.actions.size());
  if (!cost) return result::forward(cost);
  return {};
}

}  // namespace

result::Result<Trace> simulate(const Task& task, const model::Plan& plan) {
  Trace trace;
  auto executed = execute(task, plan, [&](const Executor& executor) {
    trace.cost.push_back(executor.cost().value_or(0.0));
    trace.states.push_back(name_state(task.definition(), executor.state()));
  });
  if (!executed) return result::forward(executed);
  return trace;
}

result::Result<State> state_after(const Task& task, const model::Plan& plan) {
  State state;
  std::size_t left = plan.actions.size() + 1;
  auto executed = execute(task, plan, [&](const Executor& executor) {
    if (--left == 0) state = name_state(task.definition(), executor.state());
  });
  if (!executed) return result::forward(executed);
  return state;
}

result::Result<std::vector<GoalStatus>> evaluate_goal(const Task& task, const State& state) {
  const Definition& definition = task.definition();
  auto lifted = lift(definition, state);
  if (!lifted) return result::forward(lifted);
  std::vector<GoalStatus> goals;
  const auto add = [&](const Formula& formula) {
    Binding binding(static_cast<std::size_t>(definition.goal_slots), -1);
    goals.push_back({print(definition, formula), holds(definition, formula, binding, *lifted)});
  };
  if (definition.goal.kind != FormulaKind::And) {
    add(definition.goal);
  } else {
    for (const Formula& part : definition.goal.parts) add(part);
  }
  return goals;
}

result::Result<double> evaluate_metric(const Task& task, const State& state, std::size_t steps) {
  const Definition& definition = task.definition();
  if (!definition.metric) return static_cast<double>(steps);
  auto lifted = lift(definition, state);
  if (!lifted) return result::forward(lifted);
  return cost_of(definition, Executor(definition, std::move(*lifted)), steps);
}

}  // namespace stepwright::pddl
