#include "supervisor/pddl/lifted/derive.h"

#include "supervisor/pddl/lifted/evaluate.h"

namespace stepwright::pddl {
namespace {

int layer_of(const Definition& definition, const Axiom& axiom) {
  return definition.predicates[static_cast<std::size_t>(axiom.predicate)].layer;
}

// Adds what the axiom derives now; true if there is anything new.
bool apply(const Definition& definition, const Axiom& axiom, LiftedState& state) {
  std::vector<Atom> found;
  Binding binding(static_cast<std::size_t>(axiom.slots), -1);
  for_each_binding(definition, axiom.parameters, binding, [&] {
    const auto end = binding.begin() + static_cast<std::ptrdiff_t>(axiom.parameters.size());
    Atom fact{axiom.predicate, {binding.begin(), end}};
    if (state.facts.count(fact) == 0 && holds(definition, axiom.body, binding, state)) {
      found.push_back(std::move(fact));
    }
    return true;
  });
  state.facts.insert(found.begin(), found.end());
  return !found.empty();
}

}  // namespace

void derive(const Definition& definition, LiftedState& state) {
  if (definition.axioms.empty()) return;
  std::erase_if(state.facts, [&](const Atom& fact) {
    return definition.predicates[static_cast<std::size_t>(fact.symbol)].derived;
  });
  const std::vector<Axiom>& axioms = definition.axioms;
  for (std::size_t first = 0, last = 0; first < axioms.size(); first = last) {
    while (last < axioms.size() &&
           layer_of(definition, axioms[last]) == layer_of(definition, axioms[first])) {
      ++last;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = first; i < last; ++i) changed = apply(definition, axioms[i], state) || changed;
    }
  }
}

}  // namespace stepwright::pddl
