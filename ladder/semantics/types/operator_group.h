#pragma once

// Groups of operators that are treated alike (IEC 61131-3, 7.3.2, table 71). Pure.

#include "ladder/syntax/expression.h"

namespace stepwright::semantics {

inline bool is_comparison(syntax::Operator op) {
  return op >= syntax::Operator::Equal && op <= syntax::Operator::GreaterEqual;
}

inline bool is_arithmetic(syntax::Operator op) {
  return op >= syntax::Operator::Add && op <= syntax::Operator::Modulo;
}

// The second operand is left out where the first decides.
inline bool is_short_circuit(syntax::Operator op) {
  return op == syntax::Operator::AndThen || op == syntax::Operator::OrElse;
}

// AND and OR, each with its form that leaves the second operand out where the first decides.
inline bool is_and(syntax::Operator op) {
  return op == syntax::Operator::And || op == syntax::Operator::AndThen;
}
inline bool is_or(syntax::Operator op) {
  return op == syntax::Operator::Or || op == syntax::Operator::OrElse;
}

inline bool is_logic(syntax::Operator op) {
  return is_and(op) || is_or(op) || op == syntax::Operator::Xor;
}

}  // namespace stepwright::semantics
