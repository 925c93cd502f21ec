#include "supervisor/pddl/search/space/ground_value.h"

#include <array>
#include <limits>

namespace stepwright::pddl {
namespace {

double apply(NumericKind kind, double a, double b) {
  switch (kind) {
    case NumericKind::Add:
      return a + b;
    case NumericKind::Subtract:
      return a - b;
    case NumericKind::Multiply:
      return a * b;
    default:
      return b == 0.0 ? std::numeric_limits<double>::quiet_NaN() : a / b;  // undefined, not infinite
  }
}

double run(const std::vector<NumericOperation>& program, const Word* numbers, double* stack) {
  std::size_t top = 0;  // entries in use
  for (const NumericOperation& operation : program) {
    if (operation.kind == NumericKind::Constant) {
      stack[top++] = operation.constant;
    } else if (operation.kind == NumericKind::Fluent) {
      stack[top++] = std::bit_cast<double>(numbers[operation.variable]);
    } else if (operation.kind == NumericKind::Negate) {
      stack[top - 1] = -stack[top - 1];
    } else {
      --top;
      stack[top - 1] = apply(operation.kind, stack[top - 1], stack[top]);
    }
  }
  return stack[0];
}

}  // namespace

double run_ground_program(const std::vector<NumericOperation>& program, const Word* numbers) {
  std::array<double, 64> small;
  if (program.size() <= small.size()) return run(program, numbers, small.data());
  std::vector<double> large(program.size());
  return run(program, numbers, large.data());
}

}  // namespace stepwright::pddl
