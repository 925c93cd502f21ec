#include "supervisor/pddl/grounding/reachability.h"

#include <algorithm>
#include <limits>

namespace stepwright::pddl {
namespace {

// Rounds of exact growth: enough for the capacities of usual problems to be found by stepping.
constexpr int kExactRounds = 48;

std::size_t index(int number) {
  return static_cast<std::size_t>(number);
}

}  // namespace

Reachability::Reachability(RawTask& raw, const Compiler& compiler) : raw_(raw), compiler_(compiler) {
  grow_tables();
}

void Reachability::grow_tables() {
  const Definition& definition = *raw_.definition;
  const std::vector<Atom>& facts = compiler_.facts();
  waiting_.resize(2 * facts.size());
  while (raw_.initial_facts.size() < facts.size()) {
    const int fact = static_cast<int>(raw_.initial_facts.size());
    const Atom& atom = facts[index(fact)];
    const bool holds = compiler_.holds_initially(atom);
    raw_.initial_facts.push_back(holds);
    state().literals.resize(state().literals.size() + 2, false);
    if (holds) reach(2 * fact);
    // That a derived fact may cease to hold is not followed up.
    if (!holds || definition.predicates[index(atom.symbol)].derived) reach(2 * fact + 1);
  }
  const std::vector<Atom>& variables = compiler_.variables();
  waiting_numbers_.resize(variables.size());
  dependents_.resize(variables.size());
  while (raw_.initial_values.size() < variables.size()) {
    const auto found = definition.fluents.find(variables[raw_.initial_values.size()]);
    const bool known = found != definition.fluents.end();
    const double value = known ? snap(found->second) : std::numeric_limits<double>::quiet_NaN();
    raw_.initial_values.push_back(value);
    state().values.push_back(known ? Interval::point(value) : Interval{});
  }
}

void Reachability::add_operator(GroundOperator op) {
  grow_tables();
  first_effect_.push_back(fired_.size());
  fired_.resize(fired_.size() + op.effects.size(), false);
  raw_.operators.push_back(std::move(op));
  raw_.reachable.operators.push_back(false);
  look_at({static_cast<int>(raw_.operators.size()) - 1, -1});
}

void Reachability::add_axiom(GroundAxiom axiom) {
  grow_tables();
  raw_.axioms.push_back(std::move(axiom));
  look_at({-1, static_cast<int>(raw_.axioms.size()) - 1});
}

const Condition& Reachability::condition(Unit unit) const {
  if (unit.op < 0) return raw_.axioms[index(unit.effect)].body;
  const GroundOperator& op = raw_.operators[index(unit.op)];
  return unit.effect < 0 ? op.precondition : op.effects[index(unit.effect)].when;
}

// If the condition cannot hold yet, the unit waits for something that it lacks.
bool Reachability::possible_now(const Condition& condition, Unit unit) {
  if (condition.impossible) return false;
  for (const int literal : condition.literals) {
    if (state().literals[index(literal)]) continue;
    waiting_[index(literal)].push_back(unit);
    return false;
  }
  for (const Comparison& comparison : condition.comparisons) {
    if (possible(comparison.relation, evaluate_interval(comparison.difference, state().values))) continue;
    watch(comparison.difference, unit);
    return false;
  }
  for (const auto& options : condition.choices) {
    const auto can = [&](const Condition& option) { return can_hold(option, state()); };
    if (std::any_of(options.begin(), options.end(), can)) continue;
    for (const Condition& option : options) possible_now(option, unit);
    return false;
  }
  return true;
}

void Reachability::watch(const GroundExpression& expression, Unit unit) {
  for_each_variable(expression, [&](int variable) { waiting_numbers_[index(variable)].push_back(unit); });
}

void Reachability::look_at(Unit unit) {
  if (!has_fired(unit) && possible_now(condition(unit), unit)) fire(unit);
}

bool Reachability::has_fired(Unit unit) const {
  if (unit.op < 0) return state().literals[index(2 * raw_.axioms[index(unit.effect)].fact)];
  if (unit.effect < 0) return raw_.reachable.operators[index(unit.op)];
  return fired_[first_effect_[index(unit.op)] + index(unit.effect)];
}

void Reachability::fire(Unit unit) {
  if (unit.op < 0) return reach(2 * raw_.axioms[index(unit.effect)].fact);
  if (unit.effect >= 0) return fire_effect(unit);
  raw_.reachable.operators[index(unit.op)] = true;
  const std::size_t effects = raw_.operators[index(unit.op)].effects.size();
  for (std::size_t e = 0; e < effects; ++e) look_at({unit.op, static_cast<int>(e)});
}

void Reachability::fire_effect(Unit unit) {
  const GroundOperator& op = raw_.operators[index(unit.op)];
  const GroundEffect& effect = op.effects[index(unit.effect)];
  fired_[first_effect_[index(unit.op)] + index(unit.effect)] = true;
  for (const int fact : effect.adds) reach(2 * fact);
  for (const int fact : effect.deletes) reach(2 * fact + 1);
  for (std::size_t i = 0; i < effect.numeric.size(); ++i) {
    const std::size_t growth = growths_.size();
    growths_.push_back({unit, i, true});
    due_.push_back(growth);
    const auto depend = [&](int variable) { dependents_[index(variable)].push_back(growth); };
    depend(effect.numeric[i].variable);
    for_each_variable(effect.numeric[i].amount, depend);
    for (const Condition* condition : {&op.precondition, &effect.when}) {
      for (const Comparison& comparison : condition->comparisons) {
        for_each_variable(comparison.difference, depend);
      }
    }
  }
}

void Reachability::reach(int literal) {
  if (state().literals[index(literal)]) return;
  state().literals[index(literal)] = true;
  if (literal % 2 == 0) arrived_.push_back(literal / 2);
  auto& waiting = waiting_[index(literal)];
  ready_.insert(ready_.end(), waiting.begin(), waiting.end());
  waiting = {};
}

// True if the variable's interval grew.
bool Reachability::grow(std::size_t number) {
  const Growth& growth = growths_[number];
  const GroundOperator& op = raw_.operators[index(growth.unit.op)];
  const GroundEffect& effect = op.effects[index(growth.unit.effect)];
  const NumericEffect& change = effect.numeric[growth.change];
  const std::vector<const Condition*> conditions{&op.precondition, &effect.when};
  std::vector<Interval>& values = state().values;
  Interval& value = values[index(change.variable)];
  const GroundExpression result = result_of(change);
  Interval after = implied_interval(result, conditions, values);
  if (after.empty()) return false;
  Interval grown = hull(value, after);
  if (grown == value) return false;
  const Interval before = value;
  if (round_ >= kExactRounds && !value.empty()) {
    if (grown.high > before.high) value.high = kInfinity;
    if (grown.low < before.low) value.low = -kInfinity;
    after = implied_interval(result, conditions, values);
    value = before;
    grown = hull(before, after);
    // Variables that bound each other could go on like this for ever.
    if (round_ >= 2 * kExactRounds && grown.high > before.high) grown.high = kInfinity;
    if (round_ >= 2 * kExactRounds && grown.low < before.low) grown.low = -kInfinity;
  }
  value = {snap(grown.low), snap(grown.high)};
  return !(value == before);
}

// Every change that is due, once; what reads the variables that grew is due in the next round.
void Reachability::round() {
  std::vector<std::size_t> due = std::move(due_);
  due_.clear();
  std::sort(due.begin(), due.end());
  ++round_;
  for (const std::size_t number : due) growths_[number].due = false;
  for (const std::size_t number : due) {
    if (!grow(number)) continue;
    const Growth& growth = growths_[number];
    const int variable = raw_.operators[index(growth.unit.op)]
                             .effects[index(growth.unit.effect)]
                             .numeric[growth.change]
                             .variable;
    for (const std::size_t dependent : dependents_[index(variable)]) {
      if (growths_[dependent].due) continue;
      growths_[dependent].due = true;
      due_.push_back(dependent);
    }
    auto& waiting = waiting_numbers_[index(variable)];
    ready_.insert(ready_.end(), waiting.begin(), waiting.end());
    waiting.clear();
  }
}

bool Reachability::next(int& fact) {
  while (true) {
    while (!ready_.empty()) {
      const Unit unit = ready_.back();
      ready_.pop_back();
      look_at(unit);
    }
    if (next_ < arrived_.size()) {
      fact = arrived_[next_++];
      return true;
    }
    if (due_.empty()) return false;
    round();
  }
}

}  // namespace stepwright::pddl
