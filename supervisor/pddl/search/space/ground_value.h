#pragma once

// The value of a ground expression over a state's numbers, without allocation.
//
// Thread rule: pure functions.

#include "supervisor/pddl/ground_task/expression.h"
#include "supervisor/pddl/search/space/packed_bits.h"

namespace stepwright::pddl {

// A stack program over the numbers; NaN where a division by zero or an undefined fluent takes part.
double run_ground_program(const std::vector<NumericOperation>& program, const Word* numbers);

// The value after a change.
inline double new_value(ChangeKind kind, double before, double amount) {
  switch (kind) {
    case ChangeKind::Increase:
      return before + amount;
    case ChangeKind::Decrease:
      return before - amount;
    case ChangeKind::ScaleUp:
      return before * amount;
    case ChangeKind::ScaleDown:
      return before / amount;
    default:
      return amount;
  }
}

// `numbers`: the bits of the variables' doubles.
inline double ground_value(const GroundExpression& expression, const Word* numbers) {
  if (!expression.program.empty()) return run_ground_program(expression.program, numbers);
  double sum = expression.constant;
  for (const LinearTerm& term : expression.terms) {
    sum += term.coefficient * std::bit_cast<double>(numbers[term.variable]);
  }
  return sum;
}

}  // namespace stepwright::pddl
