#include "supervisor/pddl/lifted/evaluate.h"

#include <algorithm>
#include <cmath>

#include "supervisor/pddl/numeric.h"

namespace stepwright::pddl {
namespace {

int object_of(const Term& term, const Binding& binding) {
  return term.variable ? binding[static_cast<std::size_t>(term.index)] : term.index;
}

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

bool compare_sides(const Formula& formula, const Binding& binding, const LiftedState& state) {
  const auto left = evaluate(formula.sides[0], binding, state);
  const auto right = evaluate(formula.sides[1], binding, state);
  return left && right &&
         compare(formula.relation, *left - *right, std::max(std::abs(*left), std::abs(*right)));
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
  const auto part = [&](const Formula& f) { return holds(definition, f, binding, state); };
  switch (formula.kind) {
    case FormulaKind::Atom:
      return state.facts.count(ground(formula.call, binding)) != 0;
    case FormulaKind::SameObject:
      return object_of(formula.terms[0], binding) == object_of(formula.terms[1], binding);
    case FormulaKind::Compare:
      return compare_sides(formula, binding, state);
    case FormulaKind::And:
      return std::all_of(formula.parts.begin(), formula.parts.end(), part);
    case FormulaKind::Or:
      return std::any_of(formula.parts.begin(), formula.parts.end(), part);
    case FormulaKind::Not:
      return !part(formula.parts[0]);
    case FormulaKind::Imply:
      return !part(formula.parts[0]) || part(formula.parts[1]);
    case FormulaKind::Forall:
    case FormulaKind::Exists:
      break;
  }
  const bool exists = formula.kind == FormulaKind::Exists;
  bool found = false;
  for_each_binding(definition, formula.variables, binding, [&] {
    found = part(formula.parts[0]) == exists;
    return !found;
  });
  return found == exists;
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
  for (const Expression& side : formula.sides) {
    collect_values(definition, side, binding, state, violation.values);
  }
  return violation;
}

}  // namespace stepwright::pddl
