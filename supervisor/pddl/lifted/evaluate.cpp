#include "supervisor/pddl/lifted/evaluate.h"

#include "supervisor/pddl/definition/numeric.h"

namespace stepwright::pddl {
namespace {

bool visit_from(const Definition& definition, const std::vector<Typed>& variables, std::size_t next,
                Binding& binding, const std::function<bool()>& visit) {
  if (next == variables.size()) return visit();
  const Typed& variable = variables[next];
  int& place = binding[static_cast<std::size_t>(variable.slot)];
  for (const int object : definition.objects_by_type[static_cast<std::size_t>(variable.type)]) {
    place = object;
    if (!visit_from(definition, variables, next + 1, binding, visit)) return false;
  }
  place = -1;
  return true;
}

// Whether the comparison holds, or its negation unless `positive`; with an undefined side neither does.
bool compare_sides(const Formula& formula, const Binding& binding, const LiftedState& state, bool positive) {
  const auto left = evaluate(formula.sides[0], binding, state);
  const auto right = evaluate(formula.sides[1], binding, state);
  return left && right && compare(formula.relation, *left - *right) == positive;
}

// Whether the formula holds, or its negation unless `positive`. Negations are pushed inwards, because "not"
// around an undefined comparison must not make it true.
bool decide(const Definition& definition, const Formula& formula, bool positive, Binding& binding,
            const LiftedState& state) {
  const auto part = [&](std::size_t i, bool sign) {
    return decide(definition, formula.parts[i], sign, binding, state);
  };
  switch (formula.kind) {
    case FormulaKind::Atom:
      return (state.facts.count(ground(formula.call, binding)) != 0) == positive;
    case FormulaKind::SameObject:
      return (object_of(formula.terms[0], binding) == object_of(formula.terms[1], binding)) == positive;
    case FormulaKind::Compare:
      return compare_sides(formula, binding, state, positive);
    case FormulaKind::Not:
      return part(0, !positive);
    default:
      break;
  }
  // What is left is a conjunction or a disjunction of its parts; one part of the deciding sign settles it.
  const bool conjunction = formula.kind == FormulaKind::And || formula.kind == FormulaKind::Forall;
  const bool all = conjunction == positive;
  bool settled = false;
  if (!formula.variables.empty()) {
    for_each_binding(definition, formula.variables, binding, [&] {
      settled = part(0, positive) != all;
      return !settled;
    });
  }
  for (std::size_t i = 0; formula.variables.empty() && !settled && i < formula.parts.size(); ++i) {
    settled = part(i, positive != (formula.kind == FormulaKind::Imply && i == 0)) != all;
  }
  return settled != all;
}

void collect_values(const Definition& definition, const Expression& expression, const Binding& binding,
                    const LiftedState& state, std::string& text) {
  if (expression.kind == NumericKind::Fluent) {
    const auto value = evaluate(expression, binding, state);
    text += (text.empty() ? "" : ", ") + print(definition, expression, binding) + " = " +
            (value ? number_text(*value) : "undefined");
  }
  for (const Expression& operand : expression.operands) {
    collect_values(definition, operand, binding, state, text);
  }
}

}  // namespace

int object_of(const Term& term, const Binding& binding) {
  return term.variable ? binding[static_cast<std::size_t>(term.index)] : term.index;
}

Atom ground(const Call& call, const Binding& binding) {
  Atom atom{call.symbol, {}};
  atom.arguments.reserve(call.arguments.size());
  for (const Term& term : call.arguments) atom.arguments.push_back(object_of(term, binding));
  return atom;
}

std::optional<double> evaluate(const Expression& expression, const Binding& binding,
                               const LiftedState& state) {
  if (expression.kind == NumericKind::Constant) return expression.number;
  if (expression.kind == NumericKind::Fluent) {
    const auto found = state.fluents.find(ground(expression.call, binding));
    if (found == state.fluents.end()) return std::nullopt;
    return found->second;
  }
  const auto first = evaluate(expression.operands[0], binding, state);
  if (!first) return std::nullopt;
  if (expression.kind == NumericKind::Negate) return -*first;
  double value = *first;
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    const auto next = evaluate(expression.operands[i], binding, state);
    if (!next) return std::nullopt;
    if (expression.kind == NumericKind::Add) value += *next;
    if (expression.kind == NumericKind::Subtract) value -= *next;
    if (expression.kind == NumericKind::Multiply) value *= *next;
    if (expression.kind == NumericKind::Divide) {
      if (*next == 0.0) return std::nullopt;
      value /= *next;
    }
  }
  return value;
}

void for_each_binding(const Definition& definition, const std::vector<Typed>& variables, Binding& binding,
                      const std::function<bool()>& visit) {
  visit_from(definition, variables, 0, binding, visit);
}

bool holds(const Definition& definition, const Formula& formula, Binding& binding, const LiftedState& state) {
  return decide(definition, formula, true, binding, state);
}

Violation first_violation(const Definition& definition, const Formula& formula, Binding& binding,
                          const LiftedState& state) {
  if (formula.kind == FormulaKind::And) {
    for (const Formula& part : formula.parts) {
      Violation violation = first_violation(definition, part, binding, state);
      if (!violation.condition.empty()) return violation;
    }
    return {};
  }
  if (formula.kind == FormulaKind::Forall) {
    Violation violation;
    for_each_binding(definition, formula.variables, binding, [&] {
      violation = first_violation(definition, formula.parts[0], binding, state);
      return violation.condition.empty();
    });
    return violation;
  }
  if (holds(definition, formula, binding, state)) return {};
  Violation violation{print(definition, formula, binding), {}};
  const Formula* compared = &formula;
  while (compared->kind == FormulaKind::Not) compared = &compared->parts[0];
  for (const Expression& side : compared->sides) {
    collect_values(definition, side, binding, state, violation.values);
  }
  return violation;
}

}  // namespace stepwright::pddl
