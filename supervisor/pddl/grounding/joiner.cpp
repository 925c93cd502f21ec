#include "supervisor/pddl/grounding/joiner.h"

#include <algorithm>

#include "supervisor/pddl/lifted/evaluate.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kNoTrigger = SIZE_MAX;

}  // namespace

Joiner::Joiner(const Definition& definition, const std::vector<JoinRule>& rules, Visit visit)
    : definition_(definition),
      rules_(rules),
      visit_(std::move(visit)),
      initial_(initial_state(definition)),
      triggers_(definition.predicates.size()) {
  for (const Symbol& predicate : definition.predicates) relations_.emplace_back(predicate.parameters.size());
  for (const Atom& fact : initial_.facts) {
    const bool changes = definition.predicates[static_cast<std::size_t>(fact.symbol)].changes;
    if (!changes) relation(fact.symbol).add(fact.arguments);
  }
  for (std::size_t r = 0; r < rules.size(); ++r) {
    std::vector<int> types(static_cast<std::size_t>(rules[r].slots), -1);
    for (const Typed& variable : rules[r].variables)
      types[static_cast<std::size_t>(variable.slot)] = variable.type;
    types_of_slot_.push_back(std::move(types));
    for (std::size_t a = 0; a < rules[r].atoms.size(); ++a) {
      const JoinAtom& atom = rules[r].atoms[a];
      if (atom.dynamic) triggers_[static_cast<std::size_t>(atom.predicate)].push_back({r, a});
    }
  }
  fits_.assign(definition.types.size(), std::vector<bool>(definition.objects.size(), false));
  for (std::size_t type = 0; type < definition.types.size(); ++type) {
    for (const int object : definition.objects_by_type[type])
      fits_[type][static_cast<std::size_t>(object)] = true;
  }
}

void Joiner::begin(const JoinRule& rule) {
  frame_.rule = &rule;
  frame_.types = &types_of_slot_[static_cast<std::size_t>(&rule - rules_.data())];
  frame_.trigger = kNoTrigger;
  frame_.done.assign(rule.atoms.size(), false);
  frame_.checked.assign(rule.filters.size(), false);
  frame_.binding.assign(static_cast<std::size_t>(rule.slots), -1);
}

bool Joiner::start() {
  for (const JoinRule& rule : rules_) {
    const bool waits =
        std::any_of(rule.atoms.begin(), rule.atoms.end(), [](const JoinAtom& atom) { return atom.dynamic; });
    if (waits) continue;
    begin(rule);
    std::vector<std::size_t> checked;
    if (filters_hold(checked) && !extend()) return false;
  }
  return true;
}

bool Joiner::arrive(const Atom& fact) {
  const std::vector<Trigger>& triggers = triggers_[static_cast<std::size_t>(fact.symbol)];
  if (triggers.empty()) return true;
  relation(fact.symbol).add(fact.arguments);
  for (const Trigger& trigger : triggers) {
    begin(rules_[trigger.rule]);
    frame_.trigger = trigger.atom;
    frame_.done[trigger.atom] = true;
    if (!try_row(trigger.atom, relation(fact.symbol).size() - 1)) return false;
  }
  return true;
}

// The bound arguments of the atom as a mask, their objects in key_.
std::uint64_t Joiner::bound_columns(const JoinAtom& atom) {
  std::uint64_t columns = 0;
  key_.clear();
  const std::vector<Term>& terms = *atom.terms;
  for (std::size_t i = 0; i < terms.size() && i < FactRelation::kMostIndexed; ++i) {
    const int object =
        terms[i].variable ? frame_.binding[static_cast<std::size_t>(terms[i].index)] : terms[i].index;
    if (object < 0) continue;
    columns |= std::uint64_t{1} << i;
    key_.push_back(object);
  }
  return columns;
}

std::size_t Joiner::matches(std::size_t a) {
  const JoinAtom& atom = frame_.rule->atoms[a];
  const std::uint64_t columns = bound_columns(atom);
  return columns == 0 ? relation(atom.predicate).size() : relation(atom.predicate).find(columns, key_).size();
}

// An atom before the trigger must not take the newest fact too: that binding is found from that atom.
bool Joiner::is_excluded(std::size_t a, std::size_t row) {
  if (frame_.trigger == kNoTrigger || a >= frame_.trigger) return false;
  const int predicate = frame_.rule->atoms[frame_.trigger].predicate;
  return frame_.rule->atoms[a].predicate == predicate && row + 1 == relation(predicate).size();
}

bool Joiner::bind(int slot, int object, std::vector<int>& bound) {
  int& place = frame_.binding[static_cast<std::size_t>(slot)];
  if (place >= 0) return place == object;
  const auto type = static_cast<std::size_t>((*frame_.types)[static_cast<std::size_t>(slot)]);
  if (!fits_[type][static_cast<std::size_t>(object)]) return false;
  place = object;
  bound.push_back(slot);
  return true;
}

bool Joiner::unify(std::size_t a, std::size_t row, std::vector<int>& bound) {
  const JoinAtom& atom = frame_.rule->atoms[a];
  const std::span<const int> cells = relation(atom.predicate).row(row);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Term& term = (*atom.terms)[i];
    if (term.variable ? !bind(term.index, cells[i], bound) : term.index != cells[i]) return false;
  }
  return true;
}

void Joiner::undo(const std::vector<int>& bound, const std::vector<std::size_t>& checked) {
  for (const int slot : bound) frame_.binding[static_cast<std::size_t>(slot)] = -1;
  for (const std::size_t filter : checked) frame_.checked[filter] = false;
}

bool Joiner::decided(const JoinFilter& filter) const {
  return std::all_of(filter.slots.begin(), filter.slots.end(),
                     [&](int slot) { return frame_.binding[static_cast<std::size_t>(slot)] >= 0; });
}

// The most frequent filters, equalities of objects, are decided here.
bool Joiner::holds_now(const Formula& formula) {
  const bool negated = formula.kind == FormulaKind::Not;
  const Formula& inner = negated ? formula.parts[0] : formula;
  if (inner.kind != FormulaKind::SameObject) return holds(definition_, formula, frame_.binding, initial_);
  const auto object = [&](const Term& term) {
    return term.variable ? frame_.binding[static_cast<std::size_t>(term.index)] : term.index;
  };
  return (object(inner.terms[0]) == object(inner.terms[1])) != negated;
}

bool Joiner::filters_hold(std::vector<std::size_t>& checked) {
  for (std::size_t f = 0; f < frame_.checked.size(); ++f) {
    const JoinFilter& filter = frame_.rule->filters[f];
    if (frame_.checked[f] || !decided(filter)) continue;
    if (holds_now(*filter.formula) != filter.holds) return false;
    frame_.checked[f] = true;
    checked.push_back(f);
  }
  return true;
}

// Goes on with this row for the atom, and takes it back.
bool Joiner::try_row(std::size_t atom, std::size_t row) {
  std::vector<int> bound;
  std::vector<std::size_t> checked;
  const bool go_on = !unify(atom, row, bound) || !filters_hold(checked) || extend();
  undo(bound, checked);
  return go_on;
}

bool Joiner::extend() {
  std::size_t best = SIZE_MAX;
  std::size_t fewest = SIZE_MAX;
  for (std::size_t a = 0; a < frame_.done.size(); ++a) {
    if (frame_.done[a]) continue;
    const std::size_t count = matches(a);
    if (count == 0) return true;
    if (count >= fewest) continue;
    fewest = count;
    best = a;
  }
  if (best == SIZE_MAX) return enumerate();
  frame_.done[best] = true;
  const JoinAtom& atom = frame_.rule->atoms[best];
  const std::uint64_t columns = bound_columns(atom);
  const std::span<const int> rows =
      columns == 0 ? std::span<const int>() : relation(atom.predicate).find(columns, key_);
  bool go_on = true;
  for (std::size_t i = 0; i < fewest && go_on; ++i) {
    const std::size_t row = columns == 0 ? i : static_cast<std::size_t>(rows[i]);
    if (!is_excluded(best, row)) go_on = try_row(best, row);
  }
  frame_.done[best] = false;
  return go_on;
}

// The variables that no atom binds take every object of their types.
bool Joiner::enumerate() {
  const JoinRule& rule = *frame_.rule;
  const auto unbound = std::find_if(rule.variables.begin(), rule.variables.end(), [&](const Typed& variable) {
    return frame_.binding[static_cast<std::size_t>(variable.slot)] < 0;
  });
  if (unbound == rule.variables.end()) return visit_(rule, frame_.binding);
  const bool one =
      std::find(rule.witnesses.begin(), rule.witnesses.end(), unbound->slot) != rule.witnesses.end();
  for (const int object : definition_.objects_by_type[static_cast<std::size_t>(unbound->type)]) {
    std::vector<int> bound{unbound->slot};
    std::vector<std::size_t> checked;
    frame_.binding[static_cast<std::size_t>(unbound->slot)] = object;
    const bool go_on = !filters_hold(checked) || enumerate();
    undo(bound, checked);
    if (!go_on) return false;
    if (one) break;
  }
  return true;
}

}  // namespace stepwright::pddl
