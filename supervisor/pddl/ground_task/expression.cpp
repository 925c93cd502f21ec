#include "supervisor/pddl/ground_task/expression.h"

#include <limits>

namespace stepwright::pddl {
namespace {

std::vector<NumericOperation> as_program(const GroundExpression& expression) {
  if (!expression.program.empty()) return expression.program;
  std::vector<NumericOperation> program{{NumericKind::Constant, expression.constant, -1}};
  for (const LinearTerm& term : expression.terms) {
    program.push_back({NumericKind::Constant, term.coefficient, -1});
    program.push_back({NumericKind::Fluent, 0.0, term.variable});
    program.push_back({NumericKind::Multiply, 0.0, -1});
    program.push_back({NumericKind::Add, 0.0, -1});
  }
  return program;
}

GroundExpression concatenate(NumericKind kind, const GroundExpression& a, const GroundExpression& b) {
  GroundExpression result;
  result.program = as_program(a);
  if (kind != NumericKind::Negate) {
    const std::vector<NumericOperation> right = as_program(b);
    result.program.insert(result.program.end(), right.begin(), right.end());
  }
  result.program.push_back({kind, 0.0, -1});
  return result;
}

Interval apply(NumericKind kind, const Interval& a, const Interval& b) {
  switch (kind) {
    case NumericKind::Add:
      return a + b;
    case NumericKind::Subtract:
      return a - b;
    case NumericKind::Multiply:
      return a * b;
    default:
      return a / b;
  }
}

template <typename Values>
Interval run(const std::vector<NumericOperation>& program, const Values& value) {
  std::vector<Interval> stack;
  for (const NumericOperation& operation : program) {
    if (operation.kind == NumericKind::Constant) {
      stack.push_back(Interval::point(operation.constant));
    } else if (operation.kind == NumericKind::Fluent) {
      stack.push_back(value(operation.variable));
    } else if (operation.kind == NumericKind::Negate) {
      stack.back() = -stack.back();
    } else {
      const Interval right = stack.back();
      stack.pop_back();
      stack.back() = apply(operation.kind, stack.back(), right);
    }
  }
  return stack.back();
}

}  // namespace

GroundExpression constant_expression(double value) {
  GroundExpression expression;
  expression.constant = value;
  return expression;
}

GroundExpression variable_expression(int variable) {
  GroundExpression expression;
  expression.terms.push_back({variable, 1.0});
  return expression;
}

GroundExpression partial_expression(int variable) {
  GroundExpression expression;
  expression.program.push_back({NumericKind::Fluent, 0.0, variable});
  return expression;
}

GroundExpression add_scaled(const GroundExpression& a, double factor, const GroundExpression& b) {
  if (!a.linear() || !b.linear()) {
    return concatenate(NumericKind::Add, a,
                       concatenate(NumericKind::Multiply, constant_expression(factor), b));
  }
  GroundExpression sum;
  sum.constant = a.constant + factor * b.constant;
  auto left = a.terms.begin();
  auto right = b.terms.begin();
  while (left != a.terms.end() || right != b.terms.end()) {
    LinearTerm term;
    if (right == b.terms.end() || (left != a.terms.end() && left->variable < right->variable)) {
      term = *left++;
    } else if (left == a.terms.end() || right->variable < left->variable) {
      term = {right->variable, factor * right->coefficient};
      ++right;
    } else {
      term = {left->variable, left->coefficient + factor * right->coefficient};
      ++left;
      ++right;
    }
    if (term.coefficient != 0.0) sum.terms.push_back(term);
  }
  return sum;
}

GroundExpression combine(NumericKind kind, const GroundExpression& a, const GroundExpression& b) {
  const GroundExpression zero;
  if (kind == NumericKind::Negate) return add_scaled(zero, -1.0, a);
  if (kind == NumericKind::Add) return add_scaled(a, 1.0, b);
  if (kind == NumericKind::Subtract) return add_scaled(a, -1.0, b);
  if (kind == NumericKind::Multiply && a.is_constant()) return add_scaled(zero, a.constant, b);
  if (kind == NumericKind::Multiply && b.is_constant()) return add_scaled(zero, b.constant, a);
  if (kind == NumericKind::Divide && b.is_constant()) {
    if (b.constant == 0.0) return constant_expression(std::numeric_limits<double>::quiet_NaN());
    if (a.is_constant()) return constant_expression(a.constant / b.constant);
    return add_scaled(zero, 1.0 / b.constant, a);
  }
  return concatenate(kind, a, b);
}

void for_each_variable(const GroundExpression& expression, const std::function<void(int)>& visit) {
  for (const LinearTerm& term : expression.terms) visit(term.variable);
  for (const NumericOperation& operation : expression.program) {
    if (operation.kind == NumericKind::Fluent) visit(operation.variable);
  }
}

GroundExpression substitute(const GroundExpression& expression, const std::vector<Replacement>& by) {
  const auto replace = [&](int variable) {
    const Replacement& r = by[static_cast<std::size_t>(variable)];
    if (r.variable < 0) return constant_expression(r.constant);
    return r.partial ? partial_expression(r.variable) : variable_expression(r.variable);
  };
  if (expression.linear()) {
    GroundExpression result = constant_expression(expression.constant);
    for (const LinearTerm& term : expression.terms) {
      result = add_scaled(result, term.coefficient, replace(term.variable));
    }
    return result;
  }
  // Rebuilding the program folds what has become constant, and may make it linear.
  std::vector<GroundExpression> stack;
  for (const NumericOperation& operation : expression.program) {
    if (operation.kind == NumericKind::Constant) {
      stack.push_back(constant_expression(operation.constant));
    } else if (operation.kind == NumericKind::Fluent) {
      stack.push_back(replace(operation.variable));
    } else if (operation.kind == NumericKind::Negate) {
      stack.back() = combine(operation.kind, stack.back(), {});
    } else {
      const GroundExpression right = std::move(stack.back());
      stack.pop_back();
      stack.back() = combine(operation.kind, stack.back(), right);
    }
  }
  return stack.back();
}

Interval evaluate_interval(const GroundExpression& expression, const std::vector<Interval>& values) {
  const auto value = [&](int variable) { return values[static_cast<std::size_t>(variable)]; };
  if (!expression.linear()) {
    return run(expression.program, value);
  }
  Interval sum = Interval::point(expression.constant);
  for (const LinearTerm& term : expression.terms) {
    const Interval v = value(term.variable);
    if (v.empty()) return {};
    const bool up = term.coefficient > 0.0;
    sum.low += term.coefficient * (up ? v.low : v.high);
    sum.high += term.coefficient * (up ? v.high : v.low);
  }
  return sum;
}

}  // namespace stepwright::pddl
