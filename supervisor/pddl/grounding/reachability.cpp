#include "supervisor/pddl/grounding/reachability.h"

#include <algorithm>
#include <limits>

namespace stepwright::pddl {
namespace {

// Rounds of exact growth: enough for the capacities of usual problems to be found by stepping.
constexpr int kExactRounds = 48;
// Changes of one variable by as many effects of one operator are put together in all combinations.
constexpr std::size_t kMostCombined = 5;

std::size_t index(int number) {
  return static_cast<std::size_t>(number);
}

// The bytes of a value, for keys that only have to be equal for equal values.
template <typename Value>
void append(std::string& key, Value value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

void append(std::string& key, const GroundExpression& expression) {
  append(key, expression.constant);
  append(key, expression.terms.size());
  for (const LinearTerm& term : expression.terms) {
    append(key, term.variable);
    append(key, term.coefficient);
  }
  append(key, expression.program.size());
  for (const NumericOperation& operation : expression.program) {
    append(key, operation.kind);
    append(key, operation.constant);
    append(key, operation.variable);
  }
}

bool additive(const NumericEffect& change) {
  return change.kind == ChangeKind::Increase || change.kind == ChangeKind::Decrease;
}

bool adds_to(const GroundEffect& effect, int variable) {
  return std::any_of(effect.numeric.begin(), effect.numeric.end(),
                     [&](const NumericEffect& c) { return additive(c) && c.variable == variable; });
}

// The value with all that the effect adds to the variable.
GroundExpression with_changes(GroundExpression value, const GroundEffect& effect, int variable) {
  for (const NumericEffect& change : effect.numeric) {
    if (!additive(change) || change.variable != variable) continue;
    const bool up = change.kind == ChangeKind::Increase;
    value = combine(up ? NumericKind::Add : NumericKind::Subtract, value, change.amount);
  }
  return value;
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
  effect_stamps_.resize(fired_.size(), 0);
  operator_stamps_.push_back(0);
  raw_.operators.push_back(std::move(op));
  raw_.reachable.operators.push_back(false);
  look_at({static_cast<int>(raw_.operators.size()) - 1, -1});
}

void Reachability::add_axiom(GroundAxiom axiom) {
  grow_tables();
  raw_.axioms.push_back(std::move(axiom));
  axiom_stamps_.push_back(0);
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
    waiting_[index(literal)].push_back({unit, stamp(unit)});
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
  for_each_variable(expression, [&](int variable) {
    waiting_numbers_[index(variable)].push_back({unit, stamp(unit)});
  });
}

void Reachability::look_at(Unit unit) {
  if (!has_fired(unit) && possible_now(condition(unit), unit)) fire(unit);
}

std::uint32_t& Reachability::stamp(Unit unit) {
  if (unit.op < 0) return axiom_stamps_[index(unit.effect)];
  if (unit.effect < 0) return operator_stamps_[index(unit.op)];
  return effect_stamps_[first_effect_[index(unit.op)] + index(unit.effect)];
}

void Reachability::call(std::vector<Waiting>& list) {
  for (const Waiting& waiting : list) {
    if (waiting.stamp != stamp(waiting.unit)) continue;
    ++stamp(waiting.unit);
    ready_.push_back(waiting.unit);
  }
  list = {};
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
  for (const NumericEffect& change : effect.numeric) {
    if (additive(change)) {
      add_sums(unit, change.variable);
    } else {
      add_growth(change.variable, bound_by(result_of(change), {&op.precondition, &effect.when}));
    }
  }
}

// What one application adds to the variable in several effects adds up before anything else is asked: what
// the precondition says of the value before holds for the sum. Every combination is taken when the last of
// its effects fires.
void Reachability::add_sums(Unit unit, int variable) {
  const GroundOperator& op = raw_.operators[index(unit.op)];
  const GroundEffect& effect = op.effects[index(unit.effect)];
  std::vector<const GroundEffect*> others;
  for (std::size_t e = 0; e < op.effects.size(); ++e) {
    if (e == index(unit.effect) || !fired_[first_effect_[index(unit.op)] + e]) continue;
    if (adds_to(op.effects[e], variable)) others.push_back(&op.effects[e]);
  }
  const GroundExpression alone = with_changes(variable_expression(variable), effect, variable);
  // Too many: added to any value, whatever the precondition says of it.
  if (others.size() >= kMostCombined) return add_growth(variable, {alone, {}, {}});
  for (std::size_t set = 0; set < std::size_t{1} << others.size(); ++set) {
    GroundExpression sum = alone;
    std::vector<const Condition*> conditions{&op.precondition, &effect.when};
    for (std::size_t i = 0; i < others.size(); ++i) {
      if ((set >> i & 1) == 0) continue;
      sum = with_changes(std::move(sum), *others[i], variable);
      conditions.push_back(&others[i]->when);
    }
    add_growth(variable, bound_by(std::move(sum), conditions));
  }
}

void Reachability::add_growth(int variable, BoundedExpression result) {
  std::string key;
  append(key, variable);
  append(key, result.expression);
  for (const auto* bounds : {&result.upper, &result.lower}) {
    append(key, bounds->size());
    for (const GroundExpression& bound : *bounds) append(key, bound);
  }
  if (!known_growths_.insert(std::move(key)).second) return;
  const std::size_t growth = growths_.size();
  due_.push_back(growth);
  const auto depend = [&](int read) {
    std::vector<std::size_t>& list = dependents_[index(read)];
    if (list.empty() || list.back() != growth) list.push_back(growth);
  };
  for_each_variable(result.expression, depend);
  for (const GroundExpression& bound : result.upper) for_each_variable(bound, depend);
  for (const GroundExpression& bound : result.lower) for_each_variable(bound, depend);
  growths_.push_back({variable, std::move(result), true});
}

void Reachability::reach(int literal) {
  if (state().literals[index(literal)]) return;
  state().literals[index(literal)] = true;
  if (literal % 2 == 0) arrived_.push_back(literal / 2);
  call(waiting_[index(literal)]);
}

// True if the variable's interval grew.
bool Reachability::grow(const Growth& growth) {
  std::vector<Interval>& values = state().values;
  Interval& value = values[index(growth.variable)];
  Interval after = evaluate_interval(growth.result, values);
  if (after.empty()) return false;
  Interval grown = hull(value, after);
  if (grown == value) return false;
  const Interval before = value;
  if (round_ >= kExactRounds && !value.empty()) {
    if (grown.high > before.high) value.high = kInfinity;
    if (grown.low < before.low) value.low = -kInfinity;
    after = evaluate_interval(growth.result, values);
    value = before;
    grown = hull(before, after);
    // Variables that bound each other could go on like this for ever.
    if (round_ >= 2 * kExactRounds && grown.high > before.high) grown.high = kInfinity;
    if (round_ >= 2 * kExactRounds && grown.low < before.low) grown.low = -kInfinity;
  }
  value = {snap(grown.low), snap(grown.high)};
  return !(value == before);
}

// Every change that is due, once; what has read a variable before it grew is due in the next round.
void Reachability::round() {
  std::vector<std::size_t> due = std::move(due_);
  due_.clear();
  std::sort(due.begin(), due.end());
  ++round_;
  for (const std::size_t number : due) {
    growths_[number].due = false;
    if (!grow(growths_[number])) continue;
    const int variable = growths_[number].variable;
    for (const std::size_t dependent : dependents_[index(variable)]) {
      if (growths_[dependent].due) continue;
      growths_[dependent].due = true;
      due_.push_back(dependent);
    }
    call(waiting_numbers_[index(variable)]);
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
