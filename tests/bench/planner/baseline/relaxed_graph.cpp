#include "tests/bench/planner/baseline/relaxed_graph.h"

#include <algorithm>
#include <climits>

namespace stepwright::bench {
namespace {

using pddl::ChangeKind;
using pddl::Condition;
using pddl::GroundEffect;
using pddl::GroundExpression;
using pddl::Interval;
using pddl::NumericEffect;
using pddl::Relation;

// A graph that has not met the goal by then is given up: numbers may grow without end.
constexpr int kMostLayers = 2000;

void append(Condition& to, const Condition& from) {
  to.literals.insert(to.literals.end(), from.literals.begin(), from.literals.end());
  to.comparisons.insert(to.comparisons.end(), from.comparisons.begin(), from.comparisons.end());
  to.choices.insert(to.choices.end(), from.choices.begin(), from.choices.end());
  to.impossible = to.impossible || from.impossible;
}

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

bool upwards(Relation relation) {
  return relation == Relation::Greater || relation == Relation::GreaterEqual;
}

}  // namespace

RelaxedGraph::RelaxedGraph(const pddl::StateSpace& space) : space_(space) {
  const auto& operators = space.task().operators;
  for (std::size_t i = 0; i < operators.size(); ++i) add_units(operators[i], static_cast<int>(i));
  const std::size_t literals = 2 * space.task().facts.size();
  waiting_.resize(literals);
  for (std::size_t u = 0; u < units_.size(); ++u) {
    auto& needed = units_[u].condition.literals;
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    for (const int literal : needed) waiting_[at(literal)].push_back(static_cast<int>(u));
  }
  literal_layer_.resize(literals);
  achiever_.resize(literals);
  is_wanted_.resize(literals);
  unit_layer_.resize(units_.size());
  missing_.resize(units_.size());
  selected_.resize(units_.size());
}

void RelaxedGraph::add_units(const pddl::GroundOperator& op, int index) {
  for (const GroundEffect& effect : op.effects) {
    Unit unit;
    unit.op = index;
    append(unit.condition, op.precondition);
    append(unit.condition, effect.when);
    if (unit.condition.impossible) continue;
    for (const int fact : effect.adds) unit.literals.push_back(2 * fact);
    for (const int fact : effect.deletes) unit.literals.push_back(2 * fact + 1);
    unit.numeric = effect.numeric;
    if (!unit.literals.empty() || !unit.numeric.empty()) units_.push_back(std::move(unit));
  }
}

bool RelaxedGraph::possible_at(const Goal& goal, int layer) const {
  return pddl::possible(goal.relation, evaluate_interval(goal.difference, values_[at(layer)]));
}

bool RelaxedGraph::possible_at(const Condition& condition, int layer) const {
  for (const int literal : condition.literals) {
    if (literal_layer_[at(literal)] > layer) return false;
  }
  for (const auto& comparison : condition.comparisons) {
    if (!possible_at(Goal{comparison.difference, comparison.relation}, layer)) return false;
  }
  return !condition.impossible &&
         std::all_of(condition.choices.begin(), condition.choices.end(), [&](const auto& options) {
           return std::any_of(options.begin(), options.end(),
                              [&](const Condition& option) { return possible_at(option, layer); });
         });
}

void RelaxedGraph::reach(int literal, int layer, int unit) {
  if (literal_layer_[at(literal)] <= layer) return;
  literal_layer_[at(literal)] = layer;
  achiever_[at(literal)] = unit;
  fresh_.push_back(literal);
}

Interval RelaxedGraph::changed(const NumericEffect& effect, const Values& values) const {
  const Interval amount = evaluate_interval(effect.amount, values), old = values[at(effect.variable)];
  switch (effect.kind) {
    case ChangeKind::Increase:
      return old + amount;
    case ChangeKind::Decrease:
      return old - amount;
    case ChangeKind::ScaleUp:
      return old * amount;
    case ChangeKind::ScaleDown:
      return old / amount;
    default:
      return amount;
  }
}

// The values of the next layer; false if nothing new is possible.
bool RelaxedGraph::widen(int layer) {
  Values next = values_[at(layer)];
  for (const int unit : numeric_) {
    for (const NumericEffect& effect : units_[at(unit)].numeric) {
      Interval& value = next[at(effect.variable)];
      const Interval added = changed(effect, values_[at(layer)]);
      if (!added.empty()) value = value.empty() ? added : hull(value, added);
    }
  }
  const bool grown = next != values_[at(layer)];
  values_.push_back(std::move(next));
  return grown;
}

// Whether numbers that go on growing as they did in this layer can ever make something possible that is not.
bool RelaxedGraph::growth_helps(int layer) {
  Values limit = values_[at(layer) + 1];
  for (std::size_t v = 0; v < limit.size(); ++v) {
    const Interval before = values_[at(layer)][v];
    if (limit[v].low < before.low) limit[v].low = -pddl::kInfinity;
    if (limit[v].high > before.high) limit[v].high = pddl::kInfinity;
  }
  const auto end = static_cast<int>(values_.size());
  values_.push_back(std::move(limit));
  const bool helps = possible_at(space_.task().goal, end) ||
                     std::any_of(ready_.begin(), ready_.end(),
                                 [&](int unit) { return possible_at(units_[at(unit)].condition, end); });
  values_.pop_back();
  return helps;
}

bool RelaxedGraph::build(const pddl::Word* state) {
  std::fill(literal_layer_.begin(), literal_layer_.end(), INT_MAX);
  std::fill(unit_layer_.begin(), unit_layer_.end(), INT_MAX);
  fresh_.clear();
  ready_.clear();
  numeric_.clear();
  values_.assign(1, {});
  for (std::size_t v = 0; v < space_.task().variables.size(); ++v) {
    const double value = space_.value(state, static_cast<int>(v));
    values_[0].push_back(value == value ? Interval::point(value) : Interval{});
  }
  for (std::size_t f = 0; f < space_.task().facts.size(); ++f) {
    const int fact = static_cast<int>(f);
    reach(space_.fact(state, fact) ? 2 * fact : 2 * fact + 1, 0, -1);
  }
  for (std::size_t u = 0; u < units_.size(); ++u) {
    missing_[u] = static_cast<int>(units_[u].condition.literals.size());
    if (missing_[u] == 0) ready_.push_back(static_cast<int>(u));
  }
  for (last_ = 0; last_ < kMostLayers; ++last_) {
    for (const int literal : fresh_) {
      for (const int unit : waiting_[at(literal)]) {
        if (--missing_[at(unit)] == 0) ready_.push_back(unit);
      }
    }
    fresh_.clear();
    if (possible_at(space_.task().goal, last_)) return true;
    std::vector<int> waits;
    std::size_t enabled = 0;
    for (const int unit : ready_) {
      const Unit& u = units_[at(unit)];
      if (!possible_at(u.condition, last_)) {
        waits.push_back(unit);
        continue;
      }
      unit_layer_[at(unit)] = last_;
      ++enabled;
      if (!u.numeric.empty()) numeric_.push_back(unit);
      for (const int literal : u.literals) reach(literal, last_ + 1, unit);
    }
    ready_ = std::move(waits);
    const bool grown = widen(last_);
    if (fresh_.empty() && enabled == 0 && (!grown || !growth_helps(last_))) return false;
  }
  return false;
}

std::optional<int> RelaxedGraph::estimate(const pddl::Word* state) {
  helpful_.clear();
  if (!build(state)) return std::nullopt;
  return extract();
}

int RelaxedGraph::extract() {
  wanted_.assign(at(last_) + 1, {});
  numbers_.assign(at(last_) + 1, {});
  std::fill(is_wanted_.begin(), is_wanted_.end(), 0);
  std::fill(selected_.begin(), selected_.end(), 0);
  steps_ = 0;
  want(space_.task().goal, last_);
  for (int layer = last_; layer > 0; --layer) {
    for (std::size_t i = 0; i < wanted_[at(layer)].size(); ++i) {
      select(achiever_[at(wanted_[at(layer)][i])]);
    }
    for (std::size_t i = 0; i < numbers_[at(layer)].size(); ++i) achieve(numbers_[at(layer)][i], layer);
  }
  // Every operator of the first layer that serves a literal of the second, not only the one selected.
  if (last_ > 0) {
    for (const int literal : wanted_[1]) {
      for (std::size_t u = 0; u < units_.size(); ++u) {
        if (unit_layer_[u] != 0) continue;
        const auto& made = units_[u].literals;
        if (std::find(made.begin(), made.end(), literal) != made.end()) helpful_.push_back(units_[u].op);
      }
    }
  }
  std::sort(helpful_.begin(), helpful_.end());
  helpful_.erase(std::unique(helpful_.begin(), helpful_.end()), helpful_.end());
  return steps_;
}

void RelaxedGraph::want_literal(int literal) {
  const int layer = literal_layer_[at(literal)];
  if (layer == 0 || is_wanted_[at(literal)]) return;
  is_wanted_[at(literal)] = 1;
  wanted_[at(layer)].push_back(literal);
}

// Moves the goal to the earliest layer in which it can hold.
void RelaxedGraph::want_number(Goal goal, int layer) {
  int first = 0;
  while (first < layer && !possible_at(goal, first)) ++first;
  if (first > 0) numbers_[at(first)].push_back(std::move(goal));
}

void RelaxedGraph::want(const Condition& condition, int layer) {
  for (const int literal : condition.literals) want_literal(literal);
  for (const auto& comparison : condition.comparisons) {
    if (comparison.relation == Relation::Equal) {
      want_number({comparison.difference, Relation::LessEqual}, layer);
      want_number({comparison.difference, Relation::GreaterEqual}, layer);
    } else {
      want_number({comparison.difference, comparison.relation}, layer);
    }
  }
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) {
      if (!possible_at(option, layer)) continue;
      want(option, layer);
      break;
    }
  }
}

// How far the unit moves the difference where the goal wants it, at best.
double RelaxedGraph::gain(const Unit& unit, const Goal& goal, bool up, int layer) const {
  double sum = 0.0;
  for (const NumericEffect& effect : unit.numeric) {
    const Interval before = values_[at(layer)][at(effect.variable)];
    const Interval after = changed(effect, values_[at(layer)]);
    for (const auto& term : goal.difference.terms) {
      if (term.variable != effect.variable || after.empty() || before.empty()) continue;
      const bool high = up == (term.coefficient > 0);
      sum += term.coefficient * (high ? after.high - before.high : after.low - before.low);
    }
  }
  return up ? sum : -sum;
}

// Greedily takes the units that move the difference most, until the rest can hold a layer before.
void RelaxedGraph::achieve(Goal goal, int layer) {
  const int before = layer - 1;
  const bool up = upwards(goal.relation);
  std::vector<std::pair<double, int>> gains;
  for (const int unit : numeric_) {
    if (unit_layer_[at(unit)] > before) continue;
    if (!goal.difference.linear()) {
      bool touches = false;
      for_each_variable(goal.difference, [&](int v) {
        for (const NumericEffect& effect : units_[at(unit)].numeric)
          touches = touches || effect.variable == v;
      });
      if (touches) gains.emplace_back(1.0, unit);
      continue;
    }
    const double g = gain(units_[at(unit)], goal, up, before);
    if (g > 0.0) gains.emplace_back(g, unit);
  }
  std::sort(gains.begin(), gains.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  if (before == 0) {
    for (const auto& [g, unit] : gains) helpful_.push_back(units_[at(unit)].op);
  }
  for (const auto& [g, unit] : gains) {
    if (possible_at(goal, before)) break;
    if (selected_[at(unit)]) ++steps_;  // a number may need the same operator in every layer
    select(unit);
    if (!goal.difference.linear()) return;
    goal.difference.constant += up ? g : -g;
  }
  want_number(std::move(goal), before);
}

void RelaxedGraph::select(int unit) {
  if (unit < 0 || selected_[at(unit)]) return;
  selected_[at(unit)] = 1;
  ++steps_;
  if (unit_layer_[at(unit)] == 0) helpful_.push_back(units_[at(unit)].op);
  want(units_[at(unit)].condition, unit_layer_[at(unit)]);
}

}  // namespace stepwright::bench
