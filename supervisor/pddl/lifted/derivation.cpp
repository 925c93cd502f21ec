#include "supervisor/pddl/lifted/derivation.h"

#include <algorithm>

#include "supervisor/pddl/lifted/evaluate.h"

namespace stepwright::pddl {

FactTables::FactTables(const Definition& definition, const LiftedState& state) {
  for (const Symbol& predicate : definition.predicates) tables_.emplace_back(predicate.parameters.size());
  for (const Atom& fact : state.facts) add(fact);
}

Derivation::Derivation(const Definition& definition, const std::vector<AxiomRule>& rules, FactTables& tables,
                       LiftedState& state)
    : definition_(definition), rules_(rules), tables_(tables), state_(state) {}

void Derivation::run() {
  for (const AxiomRule& rule : rules_) join_all(rule);
  spread();
  for (std::size_t known = SIZE_MAX; known != state_.facts.size();) {
    known = state_.facts.size();
    for (const AxiomRule& rule : rules_) {
      if (rule.tests_grow) join_all(rule);
    }
    spread();
  }
}

// Joins every new fact with those before it, until none is new.
void Derivation::spread() {
  while (!new_.empty()) {
    const Atom fact = std::move(new_.front());
    new_.pop_front();
    tables_.add(fact);
    for (const AxiomRule& rule : rules_) {
      for (std::size_t atom = 0; atom < rule.atoms.size(); ++atom) {
        if (rule.atoms[atom]->symbol == fact.symbol) join_newest(rule, atom);
      }
    }
  }
}

void Derivation::begin(const AxiomRule& rule) {
  rule_ = &rule;
  binding_.assign(static_cast<std::size_t>(rule.axiom->slots), -1);
  type_of_slot_.assign(binding_.size(), 0);
  for (const Typed& variable : rule.variables) {
    type_of_slot_[static_cast<std::size_t>(variable.slot)] = variable.type;
  }
  done_.assign(rule.atoms.size(), false);
  judged_.assign(rule.tests.size(), false);
}

void Derivation::join_all(const AxiomRule& rule) {
  begin(rule);
  std::vector<std::size_t> judged;
  if (tests_hold(judged)) extend();
}

void Derivation::join_newest(const AxiomRule& rule, std::size_t atom) {
  begin(rule);
  done_[atom] = true;
  try_row(atom, tables_.of(rule.atoms[atom]->symbol).size() - 1);
}

// The bound arguments of the atom as a mask, their objects in key_.
std::uint64_t Derivation::bound_columns(const Call& atom) {
  std::uint64_t columns = 0;
  key_.clear();
  for (std::size_t i = 0; i < atom.arguments.size() && i < FactRelation::kMostIndexed; ++i) {
    const Term& term = atom.arguments[i];
    const int object = term.variable ? binding_[static_cast<std::size_t>(term.index)] : term.index;
    if (object < 0) continue;
    columns |= std::uint64_t{1} << i;
    key_.push_back(object);
  }
  return columns;
}

std::size_t Derivation::matches(const Call& atom) {
  const std::uint64_t columns = bound_columns(atom);
  FactRelation& table = tables_.of(atom.symbol);
  return columns == 0 ? table.size() : table.find(columns, key_).size();
}

void Derivation::extend() {
  std::size_t best = SIZE_MAX;
  std::size_t fewest = SIZE_MAX;
  for (std::size_t a = 0; a < done_.size(); ++a) {
    if (done_[a]) continue;
    const std::size_t count = matches(*rule_->atoms[a]);
    if (count >= fewest) continue;
    fewest = count;
    best = a;
  }
  if (best == SIZE_MAX) return enumerate();
  const Call& atom = *rule_->atoms[best];
  FactRelation& table = tables_.of(atom.symbol);
  const std::uint64_t columns = bound_columns(atom);
  const std::span<const int> rows = columns == 0 ? std::span<const int>() : table.find(columns, key_);
  done_[best] = true;
  for (std::size_t i = 0; i < fewest; ++i) {
    try_row(best, columns == 0 ? i : static_cast<std::size_t>(rows[i]));
  }
  done_[best] = false;
}

// Goes on with this row for the atom, and takes it back.
void Derivation::try_row(std::size_t atom, std::size_t row) {
  std::vector<int> bound;
  std::vector<std::size_t> judged;
  if (unify(*rule_->atoms[atom], row, bound) && tests_hold(judged)) extend();
  undo(bound, judged);
}

bool Derivation::unify(const Call& atom, std::size_t row, std::vector<int>& bound) {
  const std::span<const int> cells = tables_.of(atom.symbol).row(row);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Term& term = atom.arguments[i];
    if (term.variable ? !bind(term.index, cells[i], bound) : term.index != cells[i]) return false;
  }
  return true;
}

bool Derivation::bind(int slot, int object, std::vector<int>& bound) {
  int& place = binding_[static_cast<std::size_t>(slot)];
  if (place >= 0) return place == object;
  if (!definition_.is_of_type(object, type_of_slot_[static_cast<std::size_t>(slot)])) return false;
  place = object;
  bound.push_back(slot);
  return true;
}

void Derivation::undo(const std::vector<int>& bound, const std::vector<std::size_t>& judged) {
  for (const int slot : bound) binding_[static_cast<std::size_t>(slot)] = -1;
  for (const std::size_t test : judged) judged_[test] = false;
}

bool Derivation::tests_hold(std::vector<std::size_t>& judged) {
  for (std::size_t t = 0; t < judged_.size(); ++t) {
    const AxiomTest& test = rule_->tests[t];
    if (judged_[t] || std::any_of(test.slots.begin(), test.slots.end(),
                                  [&](int slot) { return binding_[static_cast<std::size_t>(slot)] < 0; })) {
      continue;
    }
    if (!holds(definition_, *test.formula, binding_, state_)) return false;
    judged_[t] = true;
    judged.push_back(t);
  }
  return true;
}

// The variables that no atom binds take every object of their types.
void Derivation::enumerate() {
  const auto unbound = std::find_if(
      rule_->variables.begin(), rule_->variables.end(),
      [&](const Typed& variable) { return binding_[static_cast<std::size_t>(variable.slot)] < 0; });
  if (unbound == rule_->variables.end()) return conclude();
  for (const int object : definition_.objects_by_type[static_cast<std::size_t>(unbound->type)]) {
    std::vector<std::size_t> judged;
    binding_[static_cast<std::size_t>(unbound->slot)] = object;
    if (tests_hold(judged)) enumerate();
    undo({unbound->slot}, judged);
  }
}

void Derivation::conclude() {
  const auto end = binding_.begin() + static_cast<std::ptrdiff_t>(rule_->axiom->parameters.size());
  Atom fact{rule_->axiom->predicate, {binding_.begin(), end}};
  if (state_.facts.insert(fact).second) new_.push_back(std::move(fact));
}

}  // namespace stepwright::pddl
