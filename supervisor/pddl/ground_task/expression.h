#pragma once

// Ground arithmetic: a linear form where possible (fast, and bounds can be derived from it), else a small
// stack program.
//
// Thread rule: plain values, pure functions. Variables are indices into whatever array the caller evaluates
// over.

#include <functional>
#include <vector>

#include "supervisor/pddl/ground_task/interval.h"

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

}  // namespace stepwright::pddl
