#include "supervisor/pddl/lifted/derive.h"

#include "supervisor/pddl/lifted/axiom_rule.h"
#include "supervisor/pddl/lifted/derivation.h"

namespace stepwright::pddl {
namespace {

int layer_of(const Definition& definition, const Axiom& axiom) {
  return definition.predicates[static_cast<std::size_t>(axiom.predicate)].layer;
}

}  // namespace

void derive(const Definition& definition, LiftedState& state) {
  if (definition.axioms.empty()) return;
  std::erase_if(state.facts, [&](const Atom& fact) {
    return definition.predicates[static_cast<std::size_t>(fact.symbol)].derived;
  });
  FactTables tables(definition, state);
  const std::vector<Axiom>& axioms = definition.axioms;
  for (std::size_t first = 0, last = 0; first < axioms.size(); first = last) {
    while (last < axioms.size() &&
           layer_of(definition, axioms[last]) == layer_of(definition, axioms[first])) {
      ++last;
    }
    const std::vector<AxiomRule> rules = axiom_rules(definition, first, last);
    Derivation(definition, rules, tables, state).run();
  }
}

}  // namespace stepwright::pddl
