#include "supervisor/pddl/lifted/static_truth.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

bool bound(const std::vector<Term>& terms, const Binding& binding) {
  return std::all_of(terms.begin(), terms.end(),
                     [&](const Term& term) { return object_of(term, binding) >= 0; });
}

std::optional<bool> opposite_of(std::optional<bool> truth) {
  if (truth) truth = !*truth;
  return truth;
}

}  // namespace

std::optional<bool> static_truth(const Definition& definition, const Formula& formula, const Binding& binding,
                                 const LiftedState& initial) {
  const auto part = [&](std::size_t i) {
    return static_truth(definition, formula.parts[i], binding, initial);
  };
  switch (formula.kind) {
    case FormulaKind::Atom:
      if (definition.predicates[static_cast<std::size_t>(formula.call.symbol)].changes) return std::nullopt;
      if (!bound(formula.call.arguments, binding)) return std::nullopt;
      return initial.facts.count(ground(formula.call, binding)) != 0;
    case FormulaKind::SameObject:
      if (!bound(formula.terms, binding)) return std::nullopt;
      return object_of(formula.terms[0], binding) == object_of(formula.terms[1], binding);
    case FormulaKind::Not:
      return opposite_of(part(0));
    case FormulaKind::And:
    case FormulaKind::Or:
    case FormulaKind::Imply:
      break;
    case FormulaKind::Compare:
    case FormulaKind::Forall:
    case FormulaKind::Exists:
      return std::nullopt;
  }
  // One part of the deciding sign settles it, an open one leaves it open.
  const bool deciding = formula.kind != FormulaKind::And;
  std::optional<bool> all = !deciding;
  for (std::size_t i = 0; i < formula.parts.size(); ++i) {
    const bool premise = formula.kind == FormulaKind::Imply && i == 0;
    const std::optional<bool> truth = premise ? opposite_of(part(i)) : part(i);
    if (truth == deciding) return deciding;
    if (!truth) all.reset();
  }
  return all;
}

}  // namespace stepwright::pddl
