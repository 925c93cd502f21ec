#include "supervisor/translate/linear_form.h"

namespace stepwright::translate {

namespace {

using model::Expression;
using model::ExpressionKind;

void add(LinearForm& sum, const LinearForm& term, double factor) {
  sum.constant += factor * term.constant;
  for (const auto& [fluent, coefficient] : term.coefficients) {
    double& total = sum.coefficients[fluent];
    total += factor * coefficient;
    if (total == 0.0) sum.coefficients.erase(fluent);
  }
}

LinearForm scaled(const LinearForm& form, double factor) {
  LinearForm result;
  add(result, form, factor);
  return result;
}

std::optional<LinearForm> combine(ExpressionKind kind, LinearForm left, const LinearForm& right) {
  switch (kind) {
    case ExpressionKind::Sum:
      add(left, right, 1.0);
      return left;
    case ExpressionKind::Difference:
      add(left, right, -1.0);
      return left;
    case ExpressionKind::Product:
      if (right.coefficients.empty()) return scaled(left, right.constant);
      if (left.coefficients.empty()) return scaled(right, left.constant);
      return std::nullopt;
    default:
      break;
  }
  if (!right.coefficients.empty() || right.constant == 0.0) return std::nullopt;
  return scaled(left, 1.0 / right.constant);
}

}  // namespace

std::optional<LinearForm> linear_form(const Expression& expression, const Binding& binding,
                                      const model::NamedState& state) {
  if (expression.kind == ExpressionKind::Fluent && binding.sensor_of(expression.fluent) != nullptr) {
    return LinearForm{{{expression.fluent, 1.0}}, 0.0};
  }
  if (expression.kind == ExpressionKind::Constant || expression.kind == ExpressionKind::Fluent) {
    const auto value = evaluate(expression, state);
    return value ? std::optional(LinearForm{{}, *value}) : std::nullopt;
  }
  std::optional<LinearForm> form;
  for (const Expression& operand : expression.operands) {
    const auto next = linear_form(operand, binding, state);
    if (!next) return std::nullopt;
    form = form ? combine(expression.kind, std::move(*form), *next) : next;
    if (!form) return std::nullopt;
  }
  return form;
}

LinearForm difference(const LinearForm& a, const LinearForm& b) {
  LinearForm result = a;
  add(result, b, -1.0);
  return result;
}

}  // namespace stepwright::translate
