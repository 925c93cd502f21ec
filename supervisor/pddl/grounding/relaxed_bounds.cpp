#include "supervisor/pddl/grounding/relaxed_bounds.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

bool bounded_above(Relation relation) {
  return relation != Relation::Greater && relation != Relation::GreaterEqual;
}
bool bounded_below(Relation relation) {
  return relation != Relation::Less && relation != Relation::LessEqual;
}

// Tightens the upper end of `expression` by one comparison: with g <= 0 and k > 0, expression <= expression -
// k g.
double upper_by(const GroundExpression& expression, const Comparison& comparison,
                const std::vector<Interval>& values, double upper) {
  const GroundExpression& g = comparison.difference;
  if (!g.linear()) return upper;
  for (const LinearTerm& term : expression.terms) {
    const auto match = std::find_if(g.terms.begin(), g.terms.end(),
                                    [&](const LinearTerm& t) { return t.variable == term.variable; });
    if (match == g.terms.end()) continue;
    const double k = term.coefficient / match->coefficient;
    const bool usable =
        (k > 0.0 && bounded_above(comparison.relation)) || (k < 0.0 && bounded_below(comparison.relation));
    if (!usable) continue;
    const Interval rest = evaluate_interval(add_scaled(expression, -k, g), values);
    if (!rest.empty()) upper = std::min(upper, rest.high);
  }
  return upper;
}

double implied_upper(const GroundExpression& expression, const std::vector<const Condition*>& conditions,
                     const std::vector<Interval>& values, double upper) {
  for (const Condition* condition : conditions) {
    for (const Comparison& comparison : condition->comparisons) {
      upper = upper_by(expression, comparison, values, upper);
    }
  }
  return upper;
}

}  // namespace

bool can_hold(const Condition& condition, const RelaxedState& state) {
  if (condition.impossible) return false;
  for (const int literal : condition.literals) {
    if (!state.literals[static_cast<std::size_t>(literal)]) return false;
  }
  for (const Comparison& comparison : condition.comparisons) {
    if (!possible(comparison.relation, evaluate_interval(comparison.difference, state.values))) return false;
  }
  return std::all_of(condition.choices.begin(), condition.choices.end(), [&](const auto& options) {
    return std::any_of(options.begin(), options.end(),
                       [&](const Condition& o) { return can_hold(o, state); });
  });
}

Interval implied_interval(const GroundExpression& expression, const std::vector<const Condition*>& conditions,
                          const std::vector<Interval>& values) {
  Interval interval = evaluate_interval(expression, values);
  if (interval.empty() || !expression.linear() || expression.terms.empty()) return interval;
  interval.high = implied_upper(expression, conditions, values, interval.high);
  const GroundExpression negative = combine(NumericKind::Negate, expression, {});
  interval.low = -implied_upper(negative, conditions, values, -interval.low);
  // Rounding may let the ends pass each other; what is left is a point.
  if (interval.low > interval.high) interval.low = interval.high;
  return interval;
}

GroundExpression result_of(const NumericEffect& effect) {
  const GroundExpression variable = variable_expression(effect.variable);
  switch (effect.kind) {
    case ChangeKind::Increase:
      return combine(NumericKind::Add, variable, effect.amount);
    case ChangeKind::Decrease:
      return combine(NumericKind::Subtract, variable, effect.amount);
    case ChangeKind::ScaleUp:
      return combine(NumericKind::Multiply, variable, effect.amount);
    case ChangeKind::ScaleDown:
      return combine(NumericKind::Divide, variable, effect.amount);
    default:
      return effect.amount;
  }
}

}  // namespace stepwright::pddl
