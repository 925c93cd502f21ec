#pragma once

// Simulation of a plan, step by step, and evaluation of goals in a state. Evaluates the action schemas
// themselves: nothing is shared with the planner's grounded form, so that one can catch the mistakes of the
// other.
//
// Thread rule: pure functions.
//
//   auto trace = simulate(task, plan);
//   double expected = trace->states[3].value("(lev v1)").value();   // after the third action

#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

// states[i] is the state after i actions, cost[i] the value of the metric there (number of actions without a
// metric; 0 where it is undefined on the way).
struct Trace {
  std::vector<State> states;
  std::vector<double> cost;
};

// Executes the plan from the task's initial state. Fails (P03xx) at the first action that is unknown or not
// applicable, and if the metric is undefined at the end.
[[nodiscard]] result::Result<Trace> simulate(const Task& task, const model::Plan& plan);

// The state after the whole plan, without those on the way. Fails as `simulate`.
[[nodiscard]] result::Result<State> state_after(const Task& task, const model::Plan& plan);

inline constexpr const char* kUndefinedMetricHint =
    "it divides by zero there, or reads a fluent without a value";

struct GoalStatus {
  std::string text;  // "(= (level a1) 5)"
  bool met = false;
};

// Every conjunct of the goal in a state. Fails if the state names something the task does not know.
[[nodiscard]] result::Result<std::vector<GoalStatus>> evaluate_goal(const Task& task, const State& state);

// The value of the metric in a state; `steps` is its value when the task has no metric.
[[nodiscard]] result::Result<double> evaluate_metric(const Task& task, const State& state, std::size_t steps);

}  // namespace stepwright::pddl
