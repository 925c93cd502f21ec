#include "supervisor/pddl/search/space/integer_ranges.h"

#include <algorithm>
#include <cmath>

namespace stepwright::pddl {
namespace {

bool is_integer(double value) {
  return std::isfinite(value) && value == std::nearbyint(value);
}

}  // namespace

bool is_integer(const GroundExpression& expression, const std::vector<bool>& integer) {
  if (!expression.linear() || !is_integer(expression.constant)) return false;
  return std::all_of(expression.terms.begin(), expression.terms.end(), [&](const LinearTerm& term) {
    return is_integer(term.coefficient) && integer[static_cast<std::size_t>(term.variable)];
  });
}

namespace {

// Does the effect keep its variable an integer, if those that are marked are?
bool keeps(const NumericEffect& effect, const std::vector<bool>& integer) {
  if (effect.kind == ChangeKind::ScaleDown) return false;
  return is_integer(effect.amount, integer);
}

}  // namespace

std::vector<bool> integer_variables(const GroundTask& task) {
  std::vector<bool> integer;
  for (const double value : task.initial_values) integer.push_back(is_integer(value));
  for (bool changed = true; changed;) {
    changed = false;
    for (const GroundOperator& op : task.operators) {
      for (const GroundEffect& effect : op.effects) {
        for (const NumericEffect& numeric : effect.numeric) {
          const auto v = static_cast<std::size_t>(numeric.variable);
          if (!integer[v] || keeps(numeric, integer)) continue;
          integer[v] = false;
          changed = true;
        }
      }
    }
  }
  return integer;
}

}  // namespace stepwright::pddl
