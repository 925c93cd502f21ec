#include "supervisor/pddl/plan/describe_run.h"

#include <utility>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"
#include "supervisor/pddl/plan/simulate.h"

namespace stepwright::pddl {
namespace {

model::Expression to_expression(const NumericNode& node) {
  using model::ExpressionKind;
  model::Expression expression;
  expression.value = node.constant;
  expression.fluent = node.fluent;
  for (const NumericNode& operand : node.operands) expression.operands.push_back(to_expression(operand));
  switch (node.kind) {
    case NumericKind::Constant:
      expression.kind = ExpressionKind::Constant;
      break;
    case NumericKind::Fluent:
      expression.kind = ExpressionKind::Fluent;
      break;
    case NumericKind::Add:
      expression.kind = ExpressionKind::Sum;
      break;
    case NumericKind::Subtract:
      expression.kind = ExpressionKind::Difference;
      break;
    case NumericKind::Multiply:
      expression.kind = ExpressionKind::Product;
      break;
    case NumericKind::Divide:
      expression.kind = ExpressionKind::Quotient;
      break;
    case NumericKind::Negate:
      expression.kind = ExpressionKind::Difference;
      expression.operands.insert(expression.operands.begin(), model::constant(0.0));
      break;
  }
  return expression;
}

model::Comparison to_comparison(Relation relation) {
  switch (relation) {
    case Relation::Less:
      return model::Comparison::Less;
    case Relation::LessEqual:
      return model::Comparison::LessEqual;
    case Relation::Equal:
      return model::Comparison::Equal;
    case Relation::GreaterEqual:
      return model::Comparison::GreaterEqual;
    case Relation::Greater:
      return model::Comparison::Greater;
  }
  return model::Comparison::Equal;
}

model::Condition to_condition(const Requirement& requirement) {
  std::vector<model::Condition> children;
  for (const Requirement& part : requirement.parts) children.push_back(to_condition(part));
  switch (requirement.kind) {
    case RequirementKind::Fact:
      return model::fact(requirement.fact, !requirement.positive);
    case RequirementKind::Comparison:
      return model::compare(to_expression(requirement.left), to_comparison(requirement.relation),
                            to_expression(requirement.right));
    case RequirementKind::Any:
      return model::any_of(std::move(children));
    case RequirementKind::All:
      return model::all_of(std::move(children));
  }
  return {};
}

}  // namespace

model::NamedState to_named(const State& state) {
  model::NamedState named;
  named.facts.insert(state.facts().begin(), state.facts().end());
  named.fluents.insert(state.fluents().begin(), state.fluents().end());
  return named;
}

State from_named(const model::NamedState& state) {
  State result;
  for (const std::string& fact : state.facts) result.set(fact, true);
  for (const auto& [fluent, value] : state.fluents) result.assign(fluent, value);
  return result;
}

result::Result<model::PlannedRun> describe_run(const Task& task, const model::Plan& plan) {
  auto trace = simulate(task, plan);
  if (!trace) return result::forward(trace);
  ActionInspector inspector(task);
  model::PlannedRun run;
  run.initial = to_named(trace->states.front());
  run.orderings = plan.orderings;
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    auto info = inspector.inspect(plan.actions[i]);
    if (!info) return result::forward(info);
    std::vector<model::Condition> conditions;
    for (const Requirement& requirement : info->preconditions)
      conditions.push_back(to_condition(requirement));
    run.actions.push_back({plan.actions[i], model::all_of(std::move(conditions)), to_named(trace->states[i]),
                           to_named(trace->states[i + 1])});
  }
  return run;
}

}  // namespace stepwright::pddl
