#pragma once

// Builds the condition under which a standard function has a value, as an expression of its operands.
//
// Thread rule: one analysis, one thread.

#include "ladder/semantics/calls/error_test.h"
#include "ladder/semantics/expressions/expression_analyzer.h"

namespace stepwright::semantics::internal {

class ValueCondition {
 public:
  // `pou` calls the function.
  ValueCondition(Analysis& analysis, ExpressionAnalyzer& expressions, Pou& pou)
      : a_(analysis), e_(expressions), pou_(pou) {}

  // Requires operands that can be read again: constants and slots. Null for ErrorTest::None.
  ValuePtr has_value(const Value& called, ErrorTest test);
  // The function of the library that tells whether another one of it has a value; null if there is none.
  const Pou* condition_of(const Pou& function) const;

 private:
  ValuePtr compare(const Value& operand, syntax::Operator op, Constant bound);
  ValuePtr both(ValuePtr left, ValuePtr right);
  ValuePtr neither(ValuePtr wrong);
  ValuePtr is_in_range(const Value& called);
  ValuePtr fits_real(const Value& number);
  ValuePtr is_duration(const Value& called);
  ValuePtr is_in_domain(const Value& called);
  ValuePtr is_power(const Value& base, const Value& exponent);
  ValuePtr is_literal(const Value& called);
  ValuePtr takes_arguments(const Value& called);
  ValuePtr is_code(const Value& code, const Type& number);
  ValuePtr has_digits(const Value& number, const Type& code);

  Analysis& a_;
  ExpressionAnalyzer& e_;
  Pou& pou_;
};

}  // namespace stepwright::semantics::internal
