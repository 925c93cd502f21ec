#include "supervisor/translate/guard.h"

#include <cmath>
#include <optional>
#include <utility>

#include "ladder/graphic/literal_text.h"
#include "supervisor/translate/linear_form.h"

namespace stepwright::translate {

namespace {

using model::Comparison;
using model::ConditionKind;

// A part of a guard: a condition to check, or a truth value that is taken from the plan.
struct Part {
  std::optional<bool> fixed;
  graphic::Condition condition;
};

Comparison mirrored(Comparison comparison) {
  switch (comparison) {
    case Comparison::Less:
      return Comparison::Greater;
    case Comparison::LessEqual:
      return Comparison::GreaterEqual;
    case Comparison::GreaterEqual:
      return Comparison::LessEqual;
    case Comparison::Greater:
      return Comparison::Less;
    default:
      return comparison;
  }
}

bool is_upper_limit(Comparison comparison) {
  return comparison == Comparison::Less || comparison == Comparison::LessEqual;
}

class GuardBuilder {
 public:
  GuardBuilder(const model::NamedState& before, const Binding& binding, const Tare& tare,
               const Offsets& offsets)
      : before_(before), binding_(binding), tare_(tare), offsets_(offsets) {}

  Part part(const model::Condition& condition) {
    switch (condition.kind) {
      case ConditionKind::Fact:
        return fact(condition);
      case ConditionKind::Compare:
        return comparison(condition);
      case ConditionKind::All:
        return group(condition, false);
      case ConditionKind::Any:
        break;
    }
    return group(condition, true);
  }

  std::vector<std::string> take_assumed() { return std::move(assumed_); }
  std::set<std::string> take_values() { return std::move(values_); }

 private:
  // `deciding` is the truth value of a child that decides the whole group: true for Any, false for All.
  Part group(const model::Condition& condition, bool deciding) {
    std::vector<graphic::Condition> checked;
    for (const model::Condition& child : condition.children) {
      Part next = part(child);
      if (next.fixed == deciding) return {deciding, {}};
      if (!next.fixed) checked.push_back(std::move(next.condition));
    }
    if (checked.empty()) return {!deciding, {}};
    return {std::nullopt, deciding ? graphic::any(std::move(checked)) : graphic::all(std::move(checked))};
  }

  Part assume(const model::Condition& condition) {
    const bool truth = model::holds(condition, before_);
    if (truth) assumed_.push_back(to_string(condition));
    return {truth, {}};
  }

  Part fact(const model::Condition& condition) {
    const ObservedFact* observed = binding_.observed(condition.fact);
    if (observed == nullptr) return assume(condition);
    return {std::nullopt, fact_is(*observed, !condition.negated)};
  }

  Part comparison(const model::Condition& condition) {
    const auto left = linear_form(condition.left, binding_, before_);
    const auto right = linear_form(condition.right, binding_, before_);
    if (!left || !right || condition.comparison == Comparison::NotEqual) return assume(condition);
    const LinearForm form = difference(*left, *right);
    if (form.coefficients.empty()) return assume(condition);
    if (form.coefficients.size() == 1) return {std::nullopt, of_one(form, condition.comparison)};
    return {std::nullopt, of_many(form, condition.comparison)};
  }

  double tolerance(const Sensor& sensor) const {
    const auto offset = offsets_.find(sensor.fluent);
    return sensor.tolerance + (offset == offsets_.end() ? 0.0 : std::abs(offset->second));
  }

  graphic::Condition of_one(const LinearForm& form, Comparison comparison) const {
    const auto& [fluent, factor] = *form.coefficients.begin();
    const Sensor& sensor = *binding_.sensor_of(fluent);
    const std::string& type = binding_.tag(sensor.tag)->type;
    const double value = -form.constant / factor;
    const Comparison seen = factor < 0.0 ? mirrored(comparison) : comparison;
    if (seen == Comparison::Equal) return near(sensor, type, tare_, value, tolerance(sensor));
    return is_upper_limit(seen) ? at_most(sensor, type, tare_, value + tolerance(sensor))
                                : at_least(sensor, type, tare_, value - tolerance(sensor));
  }

  graphic::Condition of_many(const LinearForm& form, Comparison comparison) {
    std::string sum = real_literal(form.constant);
    double slack = 0.0;
    for (const auto& [fluent, factor] : form.coefficients) {
      const Sensor& sensor = *binding_.sensor_of(fluent);
      values_.insert(sensor.name);
      slack += std::abs(factor) * tolerance(sensor);
      sum += " + " + real_literal(factor) + " * " + value_variable(sensor);
    }
    if (comparison == Comparison::Equal) return expression("ABS(" + sum + ") <= " + real_literal(slack));
    if (is_upper_limit(comparison)) return expression(sum + " <= " + real_literal(slack));
    return expression(sum + " >= " + real_literal(-slack));
  }

  static graphic::Condition expression(std::string text) {
    graphic::Condition condition;
    condition.kind = graphic::ConditionKind::Expression;
    condition.name = std::move(text);
    return condition;
  }

  const model::NamedState& before_;
  const Binding& binding_;
  const Tare& tare_;
  const Offsets& offsets_;
  std::vector<std::string> assumed_;
  std::set<std::string> values_;
};

}  // namespace

result::Result<Guard> make_guard(const model::PlannedAction& planned, const Binding& binding,
                                 const Tare& tare, const Offsets& offsets) {
  if (!model::holds(planned.precondition, planned.before)) {
    return result::fail("T0005", {},
                        "the precondition of " + to_string(planned.action) +
                            " does not hold in the plan: " + to_string(planned.precondition),
                        "check the plan with `stepwright validate`");
  }
  GuardBuilder builder(planned.before, binding, tare, offsets);
  Part part = builder.part(planned.precondition);
  Guard guard;
  guard.condition = part.fixed ? graphic::always() : std::move(part.condition);
  guard.assumed = builder.take_assumed();
  guard.values = builder.take_values();
  return guard;
}

std::string value_variable(const Sensor& sensor) {
  return sensor.name + "_value";
}

std::string real_literal(double value) {
  return graphic::real_literal(value, 9);
}

}  // namespace stepwright::translate
