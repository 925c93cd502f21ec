#include "supervisor/pddl/lifted/axiom_rule.h"

#include <algorithm>
#include <set>

#include "supervisor/pddl/lifted/alternatives.h"

namespace stepwright::pddl {
namespace {

void erase_quantified(const Formula& formula, std::set<int>& slots) {
  for (const Typed& variable : formula.variables) slots.erase(variable.slot);
  for (const Formula& part : formula.parts) erase_quantified(part, slots);
}

bool reads_layer(const Definition& definition, const Formula& formula, int layer) {
  if (formula.kind == FormulaKind::Atom) {
    const Symbol& predicate = definition.predicates[static_cast<std::size_t>(formula.call.symbol)];
    return predicate.derived && predicate.layer == layer;
  }
  return std::any_of(formula.parts.begin(), formula.parts.end(),
                     [&](const Formula& part) { return reads_layer(definition, part, layer); });
}

AxiomRule rule_of(const Definition& definition, const Axiom& axiom, const Alternative& alternative) {
  AxiomRule rule{&axiom, axiom.parameters, {}, {}, false};
  rule.variables.insert(rule.variables.end(), alternative.variables.begin(), alternative.variables.end());
  const int layer = definition.predicates[static_cast<std::size_t>(axiom.predicate)].layer;
  for (const Formula* conjunct : alternative.conjuncts) {
    if (conjunct->kind == FormulaKind::Atom) {
      rule.atoms.push_back(&conjunct->call);
      continue;
    }
    std::set<int> slots;
    collect_slots(*conjunct, slots);
    erase_quantified(*conjunct, slots);
    rule.tests.push_back({conjunct, {slots.begin(), slots.end()}});
    rule.tests_grow = rule.tests_grow || reads_layer(definition, *conjunct, layer);
  }
  return rule;
}

}  // namespace

std::vector<AxiomRule> axiom_rules(const Definition& definition, std::size_t first, std::size_t last) {
  std::vector<AxiomRule> rules;
  for (std::size_t i = first; i < last; ++i) {
    const Axiom& axiom = definition.axioms[i];
    for (const Alternative& alternative : alternatives(axiom.body)) {
      rules.push_back(rule_of(definition, axiom, alternative));
    }
  }
  return rules;
}

}  // namespace stepwright::pddl
