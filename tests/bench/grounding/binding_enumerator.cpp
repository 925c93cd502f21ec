#include "tests/bench/grounding/binding_enumerator.h"

#include <algorithm>
#include <set>

namespace stepwright::pddl {
namespace {

bool is_static(const Definition& definition, const Expression& expression) {
  if (expression.kind == NumericKind::Fluent &&
      definition.functions[static_cast<std::size_t>(expression.call.symbol)].changes) {
    return false;
  }
  return std::all_of(expression.operands.begin(), expression.operands.end(),
                     [&](const Expression& operand) { return is_static(definition, operand); });
}

// Quantified conditions are left to the compiler.
bool is_static(const Definition& definition, const Formula& formula) {
  if (!formula.variables.empty()) return false;
  if (formula.kind == FormulaKind::Atom) {
    return !definition.predicates[static_cast<std::size_t>(formula.call.symbol)].changes;
  }
  return std::all_of(formula.sides.begin(), formula.sides.end(),
                     [&](const Expression& side) { return is_static(definition, side); }) &&
         std::all_of(formula.parts.begin(), formula.parts.end(),
                     [&](const Formula& part) { return is_static(definition, part); });
}

void slots_of(const std::vector<Term>& terms, std::set<std::size_t>& slots) {
  for (const Term& term : terms) {
    if (term.variable) slots.insert(static_cast<std::size_t>(term.index));
  }
}

void slots_of(const Expression& expression, std::set<std::size_t>& slots) {
  slots_of(expression.call.arguments, slots);
  for (const Expression& operand : expression.operands) slots_of(operand, slots);
}

std::set<std::size_t> slots_of(const Formula& formula) {
  std::set<std::size_t> slots;
  slots_of(formula.call.arguments, slots);
  slots_of(formula.terms, slots);
  for (const Expression& side : formula.sides) slots_of(side, slots);
  for (const Formula& part : formula.parts) slots.merge(slots_of(part));
  return slots;
}

}  // namespace

BindingEnumerator::BindingEnumerator(const Definition& definition, const Action& action,
                                     const LiftedState& initial)
    : BindingEnumerator(definition, action.parameters, action.slots, action.precondition, initial) {}

BindingEnumerator::BindingEnumerator(const Definition& definition, const Axiom& axiom,
                                     const LiftedState& initial)
    : BindingEnumerator(definition, axiom.parameters, axiom.slots, axiom.body, initial) {}

BindingEnumerator::BindingEnumerator(const Definition& definition, const std::vector<Typed>& parameters,
                                     int slots, const Formula& condition, const LiftedState& initial)
    : definition_(definition),
      parameters_(parameters),
      initial_(initial),
      binding_(static_cast<std::size_t>(slots), -1) {
  collect_static(condition);
  order_parameters();
}

void BindingEnumerator::collect_static(const Formula& formula) {
  if (formula.kind == FormulaKind::And) {
    for (const Formula& part : formula.parts) collect_static(part);
  } else if (is_static(definition_, formula)) {
    static_conjuncts_.push_back(&formula);
  }
}

// The parameter that the most conjuncts decide or propose; among equals the one with the fewest objects.
std::size_t BindingEnumerator::next_parameter(const std::vector<bool>& bound) const {
  std::size_t best = bound.size();
  std::size_t best_score = 0;
  std::size_t best_objects = 0;
  for (std::size_t p = 0; p < bound.size(); ++p) {
    if (bound[p]) continue;
    std::size_t score = 0;
    for (const Formula* conjunct : static_conjuncts_) {
      const std::set<std::size_t> slots = slots_of(*conjunct);
      const bool decided = slots.count(p) != 0 && std::all_of(slots.begin(), slots.end(), [&](std::size_t s) {
                             return s == p || bound[s];
                           });
      if (decided) score += conjunct->kind == FormulaKind::Atom ? 2 : 1;
    }
    const auto type = static_cast<std::size_t>(parameters_[p].type);
    const std::size_t objects = definition_.objects_by_type[type].size();
    if (best == bound.size() || score > best_score || (score == best_score && objects < best_objects)) {
      best = p;
      best_score = score;
      best_objects = objects;
    }
  }
  return best;
}

void BindingEnumerator::order_parameters() {
  std::vector<bool> bound(parameters_.size(), false);
  for (std::size_t i = 0; i < bound.size(); ++i) {
    Level level;
    level.parameter = next_parameter(bound);
    bound[level.parameter] = true;
    fill(level, bound);
    levels_.push_back(std::move(level));
  }
}

void BindingEnumerator::fill(Level& level, const std::vector<bool>& bound) {
  for (const Formula* conjunct : static_conjuncts_) {
    const std::set<std::size_t> slots = slots_of(*conjunct);
    const bool ready = slots.count(level.parameter) != 0 &&
                       std::all_of(slots.begin(), slots.end(), [&](std::size_t s) { return bound[s]; });
    if (!ready) continue;
    level.checks.push_back(conjunct);
    if (conjunct->kind == FormulaKind::Atom) index_fact(level, conjunct->call);
  }
}

void BindingEnumerator::index_fact(Level& level, const Call& call) {
  Index index;
  std::vector<std::size_t> key_places;
  std::size_t own = call.arguments.size();
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const Term& term = call.arguments[i];
    if (term.variable && static_cast<std::size_t>(term.index) == level.parameter) {
      own = i;
    } else {
      key_places.push_back(i);
      index.keys.push_back(&term);
    }
  }
  const Atom first{call.symbol, {}};
  for (auto fact = initial_.facts.lower_bound(first);
       fact != initial_.facts.end() && fact->symbol == call.symbol; ++fact) {
    const int object = fact->arguments[own];
    if (!definition_.is_of_type(object, parameters_[level.parameter].type)) continue;
    std::vector<int> key;
    for (const std::size_t place : key_places) key.push_back(fact->arguments[place]);
    std::vector<int>& objects = index.objects[std::move(key)];
    if (std::find(objects.begin(), objects.end(), object) == objects.end()) objects.push_back(object);
  }
  level.indexes.push_back(std::move(index));
}

const std::vector<int>& BindingEnumerator::candidates(const Level& level) const {
  static const std::vector<int> none;
  const auto type = static_cast<std::size_t>(parameters_[level.parameter].type);
  const std::vector<int>* best = &definition_.objects_by_type[type];
  for (const Index& index : level.indexes) {
    std::vector<int> key;
    for (const Term* term : index.keys) {
      key.push_back(term->variable ? binding_[static_cast<std::size_t>(term->index)] : term->index);
    }
    const auto found = index.objects.find(key);
    if (found == index.objects.end()) return none;
    if (found->second.size() < best->size()) best = &found->second;
  }
  return *best;
}

bool BindingEnumerator::descend(std::size_t depth, const std::function<bool(Binding&)>& visit) {
  if (depth == levels_.size()) return visit(binding_);
  const Level& level = levels_[depth];
  const std::vector<int> objects = candidates(level);
  for (const int object : objects) {
    binding_[level.parameter] = object;
    const bool allowed = std::all_of(level.checks.begin(), level.checks.end(), [&](const Formula* check) {
      return holds(definition_, *check, binding_, initial_);
    });
    if (allowed && !descend(depth + 1, visit)) return false;
  }
  binding_[level.parameter] = -1;
  return true;
}

bool BindingEnumerator::run(const std::function<bool(Binding&)>& visit) {
  return descend(0, visit);
}

}  // namespace stepwright::pddl
