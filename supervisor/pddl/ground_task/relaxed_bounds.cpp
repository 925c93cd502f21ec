#include "supervisor/pddl/ground_task/relaxed_bounds.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

bool bounded_above(Relation relation) {
  return relation != Relation::Greater && relation != Relation::GreaterEqual;
}
bool bounded_below(Relation relation) {
  return relation != Relation::Less && relation != Relation::LessEqual;
}

// What one comparison says of the upper end of `expression`: with g <= 0 and k > 0, expression <= expression
// - k g.
void add_upper_bounds(const GroundExpression& expression, const Comparison& comparison,
                      std::vector<GroundExpression>& bounds) {
  const GroundExpression& g = comparison.difference;
  if (!g.linear()) return;
  for (const LinearTerm& term : expression.terms) {
    const auto match = std::find_if(g.terms.begin(), g.terms.end(),
                                    [&](const LinearTerm& t) { return t.variable == term.variable; });
    if (match == g.terms.end()) continue;
    const double k = term.coefficient / match->coefficient;
    const bool usable =
        (k > 0.0 && bounded_above(comparison.relation)) || (k < 0.0 && bounded_below(comparison.relation));
    if (usable) bounds.push_back(add_scaled(expression, -k, g));
  }
}

// The least upper end of the bounds that are defined.
double least_high(const std::vector<GroundExpression>& bounds, const std::vector<Interval>& values,
                  double high) {
  for (const GroundExpression& bound : bounds) {
    const Interval range = evaluate_interval(bound, values);
    if (!range.empty()) high = std::min(high, range.high);
  }
  return high;
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

BoundedExpression bound_by(GroundExpression expression, const std::vector<const Condition*>& conditions) {
  BoundedExpression bounded;
  bounded.expression = std::move(expression);
  if (!bounded.expression.linear() || bounded.expression.terms.empty()) return bounded;
  const GroundExpression negative = combine(NumericKind::Negate, bounded.expression, {});
  for (const Condition* condition : conditions) {
    for (const Comparison& comparison : condition->comparisons) {
      add_upper_bounds(bounded.expression, comparison, bounded.upper);
      add_upper_bounds(negative, comparison, bounded.lower);
    }
  }
  return bounded;
}

Interval evaluate_interval(const BoundedExpression& bounded, const std::vector<Interval>& values) {
  Interval interval = evaluate_interval(bounded.expression, values);
  if (interval.empty()) return interval;
  interval.high = least_high(bounded.upper, values, interval.high);
  interval.low = -least_high(bounded.lower, values, -interval.low);
  // Rounding may let the ends pass each other; what is left is a point.
  if (interval.low > interval.high) interval.low = interval.high;
  return interval;
}

Interval implied_interval(const GroundExpression& expression, const std::vector<const Condition*>& conditions,
                          const std::vector<Interval>& values) {
  return evaluate_interval(bound_by(expression, conditions), values);
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
