#include "supervisor/pddl/plan/validate.h"

#include <algorithm>
#include <set>

#include "supervisor/pddl/definition/text.h"
#include "supervisor/pddl/lifted/executor.h"

namespace stepwright::pddl {
namespace {

void record_state(Validation& validation, const Definition& definition, const Executor& executor) {
  validation.trace.states.push_back(name_state(definition, executor.state()));
}

void record_cost(Validation& validation, const Executor& executor) {
  validation.trace.cost.push_back(executor.cost().value_or(0.0));
}

void report(Validation& validation, const PlanText& plan, std::uint32_t line, std::string code,
            std::string message, std::string hint) {
  validation.diagnostics.push_back(
      {std::move(code), result::Severity::Error, {plan.file, line, 0}, std::move(message), std::move(hint)});
}

void check_goals(Validation& validation, const Task& task, const PlanText& plan) {
  auto goals = evaluate_goal(task, validation.trace.states.back());
  if (goals) validation.goals = std::move(*goals);
  for (const GoalStatus& goal : validation.goals) {
    if (goal.met || validation.failed_step != 0) continue;
    if (validation.failed_condition.empty()) validation.failed_condition = goal.text;
    report(validation, plan, 0, "P0310", "the goal " + goal.text + " does not hold after the plan", {});
  }
}

std::string pad(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : text + std::string(width - text.size(), ' ');
}

// The names of the fluents whose values differ somewhere in the trace.
std::vector<std::string> changing_fluents(const Trace& trace) {
  std::set<std::string> names;
  for (const State& state : trace.states) {
    for (const auto& [name, value] : state.fluents()) {
      if (trace.states.front().value(name) != value) names.insert(name);
    }
  }
  return {names.begin(), names.end()};
}

std::string fact_changes(const State& before, const State& after) {
  std::string text;
  for (const std::string& fact : after.facts()) {
    if (!before.holds(fact)) text += " +" + fact;
  }
  for (const std::string& fact : before.facts()) {
    if (!after.holds(fact)) text += " -" + fact;
  }
  return text;
}

}  // namespace

Validation validate(const Task& task, const PlanText& plan, KeepStates keep) {
  const Definition& definition = task.definition();
  Executor executor(definition, initial_state(definition));
  Validation validation;
  const bool all = keep == KeepStates::All;
  if (all) record_state(validation, definition, executor);
  record_cost(validation, executor);
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    if (auto failure = executor.step(plan.actions[i])) {
      validation.failed_step = i + 1;
      validation.failed_condition = failure->violation.condition;
      validation.failed_values = failure->violation.values;
      report(
          validation, plan, plan.lines[i], failure->code,
          "step " + std::to_string(i + 1) + " " + model::to_string(plan.actions[i]) + ": " + failure->message,
          failure->hint);
      break;
    }
    if (all) record_state(validation, definition, executor);
    record_cost(validation, executor);
  }
  if (!all) record_state(validation, definition, executor);
  check_goals(validation, task, plan);
  if (!executor.cost() && validation.diagnostics.empty()) {
    report(validation, plan, 0, "P0309",
           "the metric " + print(definition, definition.metric->expression) + " is undefined after the plan",
           kUndefinedMetricHint);
  }
  validation.valid = validation.diagnostics.empty();
  return validation;
}

std::string table(const PlanText& plan, const Validation& validation) {
  const Trace& trace = validation.trace;
  const std::vector<std::string> fluents = changing_fluents(trace);
  std::size_t width = 10;
  for (const model::GroundAction& action : plan.actions)
    width = std::max(width, model::to_string(action).size());
  std::string text = pad("step", 6) + pad("action", width + 2);
  for (const std::string& fluent : fluents) text += pad(fluent, fluent.size() + 2);
  text += "cost    facts\n";
  for (std::size_t i = 0; i < trace.states.size(); ++i) {
    const std::string action = i == 0 ? "(initial)" : model::to_string(plan.actions[i - 1]);
    text += pad(std::to_string(i), 6) + pad(action, width + 2);
    for (const std::string& fluent : fluents) {
      const auto value = trace.states[i].value(fluent);
      text += pad(value ? number_text(*value) : "-", fluent.size() + 2);
    }
    text += pad(number_text(trace.cost[i]), 7);
    if (i > 0) text += fact_changes(trace.states[i - 1], trace.states[i]);
    text += "\n";
  }
  return text;
}

}  // namespace stepwright::pddl
