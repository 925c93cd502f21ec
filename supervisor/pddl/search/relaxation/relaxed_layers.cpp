#include "supervisor/pddl/search/relaxation/relaxed_layers.h"

#include <algorithm>

namespace stepwright::pddl {

RelaxedLayers::RelaxedLayers(const StateSpace& space) : space_(space) {
  const GroundTask& task = space.task();
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    const GroundOperator& op = task.operators[i];
    for (const GroundEffect& effect : op.effects) {
      Unit unit;
      unit.op = static_cast<int>(i);
      unit.condition = op.precondition;
      append(unit.condition.literals, effect.when.literals);
      append(unit.condition.comparisons, effect.when.comparisons);
      append(unit.condition.choices, effect.when.choices);
      for (const int fact : effect.adds) unit.literals.push_back(2 * fact);
      for (const int fact : effect.deletes) unit.literals.push_back(2 * fact + 1);
      unit.numeric = effect.numeric;
      if (!unit.literals.empty() || !unit.numeric.empty()) units_.push_back(std::move(unit));
    }
  }
  for (const GroundAxiom& axiom : task.axioms) units_.push_back({-1, axiom.body, {2 * axiom.fact}, {}});
  waiting_.resize(2 * task.facts.size());
  for (std::size_t u = 0; u < units_.size(); ++u) {
    for (const int literal : units_[u].condition.literals) {
      waiting_[static_cast<std::size_t>(literal)].push_back(static_cast<int>(u));
    }
  }
}

bool RelaxedLayers::numbers_can_hold(const Condition& condition) const {
  const std::vector<Interval>& now = values_[static_cast<std::size_t>(current_)];
  for (const Comparison& comparison : condition.comparisons) {
    if (!possible(comparison.relation, evaluate_interval(comparison.difference, now))) return false;
  }
  return std::all_of(condition.choices.begin(), condition.choices.end(), [&](const auto& options) {
    return std::any_of(options.begin(), options.end(), [&](const Condition& o) { return can_hold_now(o); });
  });
}

bool RelaxedLayers::can_hold_now(const Condition& condition) const {
  if (condition.impossible) return false;
  for (const int literal : condition.literals) {
    if (literal_layer(literal) > current_) return false;
  }
  return numbers_can_hold(condition);
}

void RelaxedLayers::start(const Word* state) {
  const GroundTask& task = space_.task();
  literal_layer_.assign(2 * task.facts.size(), kNever);
  achiever_.assign(2 * task.facts.size(), -1);
  unit_layer_.assign(units_.size(), kNever);
  missing_.resize(units_.size());
  candidates_.clear();
  numeric_units_.clear();
  fresh_.clear();
  current_ = 0;
  if (values_.empty()) values_.emplace_back();
  values_[0].clear();
  for (std::size_t v = 0; v < task.variables.size(); ++v) {
    const double value = space_.value(state, static_cast<int>(v));
    values_[0].push_back(value == value ? Interval::point(value) : Interval{});
  }
  for (std::size_t u = 0; u < units_.size(); ++u) {
    missing_[u] = static_cast<int>(units_[u].condition.literals.size());
    if (missing_[u] == 0) candidates_.push_back(static_cast<int>(u));
  }
  for (std::size_t f = 0; f < task.facts.size(); ++f) {
    reach(2 * static_cast<int>(f) + (space_.fact(state, static_cast<int>(f)) ? 0 : 1), -1, 0);
  }
  // That a derived fact ceases to hold costs nothing here.
  for (int f = task.first_derived; f < static_cast<int>(task.facts.size()); ++f) reach(2 * f + 1, -1, 0);
}

void RelaxedLayers::reach(int literal, int unit, int layer) {
  const auto place = static_cast<std::size_t>(literal);
  if (literal_layer_[place] != kNever) return;
  literal_layer_[place] = layer;
  achiever_[place] = unit;
  fresh_.push_back(literal);
}

void RelaxedLayers::enable(int unit, int layer) {
  unit_layer_[static_cast<std::size_t>(unit)] = layer;
  const Unit& enabled = units_[static_cast<std::size_t>(unit)];
  for (const int literal : enabled.literals) reach(literal, unit, layer + 1);
  if (!enabled.numeric.empty()) numeric_units_.push_back(unit);
}

// The ranges of the next layer; true if any grew.
bool RelaxedLayers::grow(int layer, std::vector<Interval>& next) {
  const std::vector<Interval>& now = values_[static_cast<std::size_t>(layer)];
  const std::vector<Interval>& bounds = space_.task().bounds;
  next = now;
  for (const int u : numeric_units_) {
    for (const NumericEffect& effect : units_[static_cast<std::size_t>(u)].numeric) {
      Interval& target = next[static_cast<std::size_t>(effect.variable)];
      const Interval amount = evaluate_interval(effect.amount, now);
      const Interval before = now[static_cast<std::size_t>(effect.variable)];
      if (amount.empty() || (effect.kind != ChangeKind::Assign && before.empty())) continue;
      if (effect.kind == ChangeKind::Increase || effect.kind == ChangeKind::Decrease) {
        const Interval change = effect.kind == ChangeKind::Increase ? amount : -amount;
        target.low += std::min(0.0, change.low);
        target.high += std::max(0.0, change.high);
      } else if (effect.kind == ChangeKind::Assign) {
        target = hull(target, amount);
      } else {
        target = hull(target, effect.kind == ChangeKind::ScaleUp ? before * amount : before / amount);
      }
    }
  }
  bool grew = false;
  for (std::size_t v = 0; v < next.size(); ++v) {
    if (next[v].empty()) continue;
    next[v].low = std::max(next[v].low, std::min(bounds[v].low, now[v].low));
    next[v].high = std::min(next[v].high, std::max(bounds[v].high, now[v].high));
    grew = grew || !(next[v] == now[v]);
  }
  return grew;
}

// Builds layer + 1. False if it is the same as this one.
bool RelaxedLayers::step(int layer) {
  const std::vector<int> reached = std::move(fresh_);
  fresh_.clear();
  for (const int literal : reached) {
    for (const int unit : waiting_[static_cast<std::size_t>(literal)]) {
      if (--missing_[static_cast<std::size_t>(unit)] == 0) candidates_.push_back(unit);
    }
  }
  std::size_t kept = 0;
  bool enabled = false;
  std::sort(candidates_.begin(), candidates_.end());
  for (const int unit : candidates_) {
    if (numbers_can_hold(units_[static_cast<std::size_t>(unit)].condition)) {
      enable(unit, layer);
      enabled = true;
    } else {
      candidates_[kept++] = unit;
    }
  }
  candidates_.resize(kept);
  const auto next = static_cast<std::size_t>(layer) + 1;
  if (values_.size() <= next) values_.emplace_back();
  std::vector<Interval> grown = std::move(values_[next]);
  const bool grew = grow(layer, grown);
  values_[next] = std::move(grown);
  current_ = layer + 1;
  return enabled || grew || !fresh_.empty();
}

// When only numbers still grow: would a goal or a waiting unit become possible if they grew for ever? If not,
// they will not.
bool RelaxedLayers::widened_helps() {
  std::vector<Interval>& now = values_[static_cast<std::size_t>(current_)];
  const std::vector<Interval> saved = now;
  const std::vector<Interval>& before = values_[static_cast<std::size_t>(current_ - 1)];
  const std::vector<Interval>& bounds = space_.task().bounds;
  for (std::size_t v = 0; v < now.size(); ++v) {
    if (now[v].high > before[v].high) now[v].high = std::max(now[v].high, bounds[v].high);
    if (now[v].low < before[v].low) now[v].low = std::min(now[v].low, bounds[v].low);
  }
  const bool helps =
      can_hold_now(space_.task().goal) || std::any_of(candidates_.begin(), candidates_.end(), [&](int u) {
        return numbers_can_hold(units_[static_cast<std::size_t>(u)].condition);
      });
  now = saved;
  return helps;
}

bool RelaxedLayers::build(const Word* state) {
  start(state);
  // Ranges may grow in ever smaller steps; a goal that so many layers do not reach counts as far, not as
  // impossible.
  constexpr int kMostLayers = 2000;
  std::size_t idle_since = 0;
  for (last_ = 0; last_ < kMostLayers; ++last_) {
    if (can_hold_now(space_.task().goal)) return true;
    const std::size_t before = candidates_.size();
    if (!step(last_)) return can_hold_now(space_.task().goal);
    const bool only_numbers = fresh_.empty() && candidates_.size() >= before;
    idle_since = only_numbers ? idle_since + 1 : 0;
    // Two idle layers, so that chains of variables that feed each other show their growth.
    if (idle_since > space_.task().variables.size() + 1 && !widened_helps()) return false;
  }
  return true;
}

}  // namespace stepwright::pddl
