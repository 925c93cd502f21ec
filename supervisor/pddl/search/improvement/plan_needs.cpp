#include "supervisor/pddl/search/improvement/plan_needs.h"

#include <algorithm>
#include <tuple>

#include "supervisor/pddl/ground_task/relaxed_bounds.h"

namespace stepwright::pddl {
namespace {

// The expression before the effects, which happen together. Not linear where an effect is not.
GroundExpression before_effects(const GroundExpression& after,
                                const std::vector<const NumericEffect*>& effects) {
  GroundExpression before = after;
  for (const NumericEffect* effect : effects) {
    const auto term = std::find_if(after.terms.begin(), after.terms.end(),
                                   [&](const LinearTerm& t) { return t.variable == effect->variable; });
    if (term == after.terms.end()) continue;
    const GroundExpression change =
        combine(NumericKind::Subtract, result_of(*effect), variable_expression(effect->variable));
    before = add_scaled(before, term->coefficient, change);
  }
  return before;
}

}  // namespace

bool PlanNeeds::Sum::operator<(const Sum& other) const {
  const auto less = [](const LinearTerm& a, const LinearTerm& b) {
    return std::tie(a.variable, a.coefficient) < std::tie(b.variable, b.coefficient);
  };
  if (relation != other.relation) return relation < other.relation;
  return std::lexicographical_compare(terms.begin(), terms.end(), other.terms.begin(), other.terms.end(),
                                      less);
}

PlanNeeds::PlanNeeds(const StateSpace& space, const Word* last)
    : space_(space),
      literals_(2 * space.task().facts.size(), false),
      variables_(space.task().variables.size(), false) {
  need(space.task().goal, last);
  need_at_most(space.task().potential, last);
}

void PlanNeeds::need_variables(const GroundExpression& expression) {
  for_each_variable(expression, [this](int v) { variables_[static_cast<std::size_t>(v)] = true; });
}

void PlanNeeds::need_at_most(const GroundExpression& cost, const Word* state) {
  GroundExpression difference = cost;
  difference.constant -= space_.evaluate(cost, state);
  need(Comparison{std::move(difference), Relation::LessEqual});
}

// Of a choice, every part is to stay as it is: which option was taken does not matter then.
void PlanNeeds::need(const Condition& condition, const Word* state) {
  for (const int literal : condition.literals) literals_[static_cast<std::size_t>(literal)] = true;
  for (const Comparison& comparison : condition.comparisons) need(comparison);
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) need_all(option, state);
  }
}

// Of comparisons of the same sum only the strictest counts.
void PlanNeeds::need(Comparison comparison) {
  GroundExpression& difference = comparison.difference;
  if (!difference.linear()) return need_variables(difference);
  if (difference.terms.empty()) return;
  Relation& relation = comparison.relation;
  if (relation == Relation::Less || relation == Relation::LessEqual) {
    relation = relation == Relation::Less ? Relation::Greater : Relation::GreaterEqual;
    difference = combine(NumericKind::Negate, difference, {});
  }
  const auto [place, added] =
      sums_.try_emplace({relation, std::move(difference.terms)}, -difference.constant);
  if (!added) place->second = std::max(place->second, -difference.constant);
}

void PlanNeeds::need_all(const Condition& condition, const Word* state) {
  for (const int literal : condition.literals) {
    const int fact = literal / 2;
    literals_[static_cast<std::size_t>(2 * fact + (space_.fact(state, fact) ? 0 : 1))] = true;
  }
  for (const Comparison& comparison : condition.comparisons) need_variables(comparison.difference);
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) need_all(option, state);
  }
}

// What the rest needs of the numbers after the effects, as needs before them.
void PlanNeeds::regress_numbers(const std::vector<const NumericEffect*>& effects) {
  const std::vector<bool> after = variables_;
  for (const NumericEffect* effect : effects) {
    if (effect->kind == ChangeKind::Assign) variables_[static_cast<std::size_t>(effect->variable)] = false;
  }
  for (const NumericEffect* effect : effects) {
    const auto v = static_cast<std::size_t>(effect->variable);
    if (after[v] || !effect->amount.linear()) need_variables(effect->amount);
    // A variable that may be undefined can be changed only where it is not.
    const double initial = space_.task().initial_values[v];
    if (effect->kind != ChangeKind::Assign && initial != initial) variables_[v] = true;
  }
  std::map<Sum, double> sums;
  sums.swap(sums_);
  for (const auto& [sum, number] : sums) {
    const GroundExpression whole{sum.terms, -number, {}};
    GroundExpression before = before_effects(whole, effects);
    if (before.linear()) {
      need(Comparison{std::move(before), sum.relation});
    } else {
      need_variables(before);
    }
  }
}

void PlanNeeds::prepend(int op, const Word* before) {
  const GroundOperator& whole = space_.task().operators[static_cast<std::size_t>(op)];
  std::vector<const NumericEffect*> numeric;
  for (const GroundEffect& effect : whole.effects) {
    if (!effect.when.always() && !space_.holds(effect.when, before)) continue;
    for (const NumericEffect& change : effect.numeric) numeric.push_back(&change);
    for (const int fact : effect.deletes) literals_[2 * static_cast<std::size_t>(fact) + 1] = false;
  }
  for (const GroundEffect& effect : whole.effects) {
    if (!effect.when.always() && !space_.holds(effect.when, before)) continue;
    for (const int fact : effect.adds) literals_[2 * static_cast<std::size_t>(fact)] = false;
  }
  if (!numeric.empty()) regress_numbers(numeric);
  need(whole.precondition, before);
  for (const GroundEffect& effect : whole.effects) {
    need_all(effect.when, before);
    need_at_most(effect.cost, before);
  }
}

std::vector<int> PlanNeeds::literals() const {
  std::vector<int> list;
  for (std::size_t l = 0; l < literals_.size(); ++l) {
    if (literals_[l]) list.push_back(static_cast<int>(l));
  }
  return list;
}

std::vector<Comparison> PlanNeeds::comparisons(const Word* state) const {
  std::vector<Comparison> list;
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    if (!variables_[v]) continue;
    const int variable = static_cast<int>(v);
    list.push_back({{{{variable, 1.0}}, -space_.value(state, variable), {}}, Relation::Equal});
  }
  for (const auto& [sum, number] : sums_) {
    const bool kept = std::all_of(sum.terms.begin(), sum.terms.end(), [&](const LinearTerm& term) {
      return variables_[static_cast<std::size_t>(term.variable)];
    });
    if (!kept) list.push_back({{sum.terms, -number, {}}, sum.relation});
  }
  return list;
}

}  // namespace stepwright::pddl
