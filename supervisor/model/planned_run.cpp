#include "supervisor/model/planned_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace stepwright::model {

namespace {

constexpr double kSlack = 1e-9;

const char* symbol(ExpressionKind kind) {
  switch (kind) {
    case ExpressionKind::Sum:
      return "+";
    case ExpressionKind::Difference:
      return "-";
    case ExpressionKind::Product:
      return "*";
    default:
      return "/";
  }
}

const char* symbol(Comparison comparison) {
  switch (comparison) {
    case Comparison::Less:
      return "<";
    case Comparison::LessEqual:
      return "<=";
    case Comparison::Equal:
      return "=";
    case Comparison::NotEqual:
      return "!=";
    case Comparison::GreaterEqual:
      return ">=";
    case Comparison::Greater:
      return ">";
  }
  return "=";
}

bool compares(double left, Comparison comparison, double right) {
  const double difference = left - right;
  switch (comparison) {
    case Comparison::Less:
      return difference < -kSlack;
    case Comparison::LessEqual:
      return difference <= kSlack;
    case Comparison::Equal:
      return std::abs(difference) <= kSlack;
    case Comparison::NotEqual:
      return std::abs(difference) > kSlack;
    case Comparison::GreaterEqual:
      return difference >= -kSlack;
    case Comparison::Greater:
      return difference > kSlack;
  }
  return false;
}

std::optional<double> combine(ExpressionKind kind, double left, double right) {
  switch (kind) {
    case ExpressionKind::Sum:
      return left + right;
    case ExpressionKind::Difference:
      return left - right;
    case ExpressionKind::Product:
      return left * right;
    default:
      break;
  }
  if (right == 0.0) return std::nullopt;
  return left / right;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

}  // namespace

Expression constant(double value) {
  Expression expression;
  expression.value = value;
  return expression;
}

Expression fluent(std::string name) {
  Expression expression;
  expression.kind = ExpressionKind::Fluent;
  expression.fluent = std::move(name);
  return expression;
}

Condition fact(std::string name, bool negated) {
  Condition condition;
  condition.kind = ConditionKind::Fact;
  condition.fact = std::move(name);
  condition.negated = negated;
  return condition;
}

Condition compare(Expression left, Comparison comparison, Expression right) {
  Condition condition;
  condition.kind = ConditionKind::Compare;
  condition.comparison = comparison;
  condition.left = std::move(left);
  condition.right = std::move(right);
  return condition;
}

Condition all_of(std::vector<Condition> children) {
  Condition condition;
  condition.children = std::move(children);
  return condition;
}

Condition any_of(std::vector<Condition> children) {
  Condition condition;
  condition.kind = ConditionKind::Any;
  condition.children = std::move(children);
  return condition;
}

std::optional<double> evaluate(const Expression& expression, const NamedState& state) {
  if (expression.kind == ExpressionKind::Constant) return expression.value;
  if (expression.kind == ExpressionKind::Fluent) {
    const auto found = state.fluents.find(expression.fluent);
    if (found == state.fluents.end()) return std::nullopt;
    return found->second;
  }
  std::optional<double> value;
  for (const Expression& operand : expression.operands) {
    const std::optional<double> next = evaluate(operand, state);
    if (!next) return std::nullopt;
    value = value ? combine(expression.kind, *value, *next) : next;
    if (!value) return std::nullopt;
  }
  return value;
}

bool holds(const Condition& condition, const NamedState& state) {
  const auto holds_here = [&state](const Condition& child) { return holds(child, state); };
  switch (condition.kind) {
    case ConditionKind::All:
      return std::all_of(condition.children.begin(), condition.children.end(), holds_here);
    case ConditionKind::Any:
      return std::any_of(condition.children.begin(), condition.children.end(), holds_here);
    case ConditionKind::Fact:
      return state.facts.contains(condition.fact) != condition.negated;
    case ConditionKind::Compare:
      break;
  }
  const std::optional<double> left = evaluate(condition.left, state);
  const std::optional<double> right = evaluate(condition.right, state);
  return left && right && compares(*left, condition.comparison, *right);
}

std::string to_string(const Expression& expression) {
  if (expression.kind == ExpressionKind::Constant) return number(expression.value);
  if (expression.kind == ExpressionKind::Fluent) return expression.fluent;
  std::string text = std::string("(") + symbol(expression.kind);
  for (const Expression& operand : expression.operands) text += " " + to_string(operand);
  return text + ")";
}

std::string to_string(const Condition& condition) {
  switch (condition.kind) {
    case ConditionKind::Fact:
      return condition.negated ? "(not " + condition.fact + ")" : condition.fact;
    case ConditionKind::Compare:
      return std::string("(") + symbol(condition.comparison) + " " + to_string(condition.left) + " " +
             to_string(condition.right) + ")";
    default:
      break;
  }
  std::string text = condition.kind == ConditionKind::All ? "(and" : "(or";
  for (const Condition& child : condition.children) text += " " + to_string(child);
  return text + ")";
}

}  // namespace stepwright::model
