#pragma once

// Ground arithmetic: a linear form where possible (fast, and bounds can be derived from it), else a small
// stack program.
//
// Thread rule: plain values, pure functions. Variables are indices into whatever array the caller evaluates
// over.

#include <functional>
#include <vector>

#include "supervisor/pddl/grounding/interval.h"

namespace stepwright::pddl {

struct LinearTerm {
  int variable = 0;
  double coefficient = 0.0;
  friend bool operator==(const LinearTerm&, const LinearTerm&) = default;
};

struct NumericOperation {
  NumericKind kind = NumericKind::Constant;
  double constant = 0.0;
  int variable = -1;
};

struct GroundExpression {
  std::vector<LinearTerm> terms;  // by variable, no zero coefficients
  double constant = 0.0;
  std::vector<NumericOperation> program;  // postfix; if not empty, it alone counts

  bool linear() const { return program.empty(); }
  bool is_constant() const { return program.empty() && terms.empty(); }
};

GroundExpression constant_expression(double value);
GroundExpression variable_expression(int variable);

// NaN where `b` is zero: division by zero is undefined, not infinite.
double quotient(double a, double b);

// A variable that may have no value: a program, because in a linear form x - x and 0 x would be 0 even where
// x is undefined.
GroundExpression partial_expression(int variable);

// kind: Add, Subtract, Multiply, Divide (two operands) or Negate (b ignored).
GroundExpression combine(NumericKind kind, const GroundExpression& a, const GroundExpression& b);

// a + factor * b.
GroundExpression add_scaled(const GroundExpression& a, double factor, const GroundExpression& b);

void for_each_variable(const GroundExpression& expression, const std::function<void(int)>& visit);

// Renames every variable, or puts a constant in its place.
struct Replacement {
  int variable = -1;  // -1: the constant
  double constant = 0.0;
  bool partial = false;  // the variable may have no value
};
GroundExpression substitute(const GroundExpression& expression, const std::vector<Replacement>& by);

Interval evaluate_interval(const GroundExpression& expression, const std::vector<Interval>& values);

// Evaluates a program over a stack; `value` maps a variable to a double. NaN where a division by zero or an
// undefined fluent (itself NaN) takes part.
double run_program(const std::vector<NumericOperation>& program, const std::function<double(int)>& value);

// `value`: any callable int -> double.
template <typename Values>
double evaluate_with(const GroundExpression& expression, const Values& value) {
  if (!expression.program.empty()) return run_program(expression.program, value);
  double sum = expression.constant;
  for (const LinearTerm& term : expression.terms) sum += term.coefficient * value(term.variable);
  return sum;
}

}  // namespace stepwright::pddl
