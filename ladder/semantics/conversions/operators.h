#pragma once

// Operators on values (IEC 61131-3, 7.3.2, table 71): the types of operands and results, folding of
// constants.
//
// Thread rule: one analysis, one thread. Null means that the reason was reported, or that an operand was
// null.

#include "ladder/semantics/conversions/conversions.h"

namespace stepwright::semantics::internal {

class Operators {
 public:
  Operators(Analysis& analysis, Conversions& conversions) : a_(analysis), c_(conversions) {}

  ValuePtr unary(syntax::Operator op, ValuePtr operand, Position where);
  ValuePtr invert(ValuePtr operand, Position where);
  ValuePtr combine(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr power(ValuePtr base, ValuePtr exponent, Position where);
  // The result, unless it is a function of literals that has no value; then null after a report.
  ValuePtr defined(ValuePtr result, Position where);
  // The narrowest type that holds every value of both; null if there is none.
  const Type* common_type(const Value& left, const Value& right) const;
  bool operator_applies(syntax::Operator op, const Type& type) const;

 private:
  // operators.cpp
  ValuePtr combine_bits(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr compare_texts(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr fold_literals(syntax::Operator op, const Value& left, const Value& right, Position where);
  ValuePtr bad_operands(syntax::Operator op, const Value& left, const Value& right, Position where);
  // time_operators.cpp
  ValuePtr combine_time(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr scale_time(syntax::Operator op, ValuePtr left, ValuePtr right, Position where);
  ValuePtr within_day(ValuePtr value);

  Analysis& a_;
  Conversions& c_;
};

}  // namespace stepwright::semantics::internal
