#include "supervisor/pddl/search/relaxation/relaxed_plan.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// How far the interval is from standing in the relation to zero; 0 if it can. Sets `upwards` to the side that
// must move.
double gap(Relation relation, Interval difference, bool& upwards) {
  const bool wants_up = relation == Relation::Greater || relation == Relation::GreaterEqual ||
                        (relation == Relation::Equal && difference.high < 0.0);
  upwards = wants_up;
  if (difference.empty()) return kInfinity;
  const double distance = wants_up ? -difference.high : difference.low;
  const bool strict = relation == Relation::Greater || relation == Relation::Less;
  return std::max(0.0, distance) + (strict && distance >= 0.0 ? 1e-9 : 0.0);
}

}  // namespace

RelaxedPlan::RelaxedPlan(const StateSpace& space) : space_(space), layers_(space) {
  changers_.resize(space.task().variables.size());
  for (std::size_t u = 0; u < layers_.units().size(); ++u) {
    for (const NumericEffect& effect : layers_.units()[u].numeric) {
      std::vector<int>& list = changers_[static_cast<std::size_t>(effect.variable)];
      if (list.empty() || list.back() != static_cast<int>(u)) list.push_back(static_cast<int>(u));
    }
  }
  literal_mark_.assign(2 * space.task().facts.size(), 0);
  unit_mark_.assign(layers_.units().size(), 0);
  helpful_mark_.assign(space.task().operators.size(), 0);
}

bool RelaxedPlan::evaluate(const Word* state) {
  if (!layers_.build(state)) return false;
  extract();
  return true;
}

void RelaxedPlan::extract() {
  ++evaluation_;
  steps_ = 0;
  cost_ = 0.0;
  helpful_.clear();
  const auto count = static_cast<std::size_t>(layers_.last()) + 1;
  if (literal_goals_.size() < count) {
    literal_goals_.resize(count);
    numeric_goals_.resize(count);
  }
  require(space_.task().goal, layers_.last());
  for (int layer = layers_.last(); layer > 0; --layer) {
    achieve_literals(layer);
    auto& goals = numeric_goals_[static_cast<std::size_t>(layer)];
    for (std::size_t i = 0; i < goals.size(); ++i) achieve(std::move(goals[i]), layer);
    goals.clear();
  }
  std::sort(helpful_.begin(), helpful_.end());
}

int RelaxedPlan::first_layer(const GroundExpression& difference, Relation relation, int limit) const {
  int low = 0;
  int high = limit;
  // Ranges only grow from layer to layer, so the first good layer can be found by halving.
  while (low < high) {
    const int middle = (low + high) / 2;
    if (possible(relation, evaluate_interval(difference, layers_.values(middle)))) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

int RelaxedPlan::first_layer(const Condition& condition, int limit) const {
  if (condition.impossible) return RelaxedLayers::kNever;
  int layer = 0;
  for (const int literal : condition.literals) layer = std::max(layer, layers_.literal_layer(literal));
  for (const Comparison& comparison : condition.comparisons) {
    layer = std::max(layer, first_layer(comparison.difference, comparison.relation, limit));
  }
  for (const auto& options : condition.choices) {
    int best = RelaxedLayers::kNever;
    for (const Condition& option : options) best = std::min(best, first_layer(option, limit));
    layer = std::max(layer, best);
  }
  return layer;
}

void RelaxedPlan::require_number(GroundExpression difference, Relation relation, int layer) {
  const int first = first_layer(difference, relation, layer);
  if (first == 0) return;
  numeric_goals_[static_cast<std::size_t>(first)].push_back({std::move(difference), relation});
}

void RelaxedPlan::require(const Condition& condition, int layer) {
  for (const int literal : condition.literals) {
    const int first = layers_.literal_layer(literal);
    std::int32_t& mark = literal_mark_[static_cast<std::size_t>(literal)];
    if (first == 0 || first > layer || mark == evaluation_) continue;
    mark = evaluation_;
    literal_goals_[static_cast<std::size_t>(first)].push_back(literal);
  }
  for (const Comparison& comparison : condition.comparisons) {
    require_number(comparison.difference, comparison.relation, layer);
  }
  for (const auto& options : condition.choices) {
    const auto easiest = std::min_element(options.begin(), options.end(), [&](const auto& a, const auto& b) {
      return first_layer(a, layer) < first_layer(b, layer);
    });
    require(*easiest, layer);
  }
}

void RelaxedPlan::select(int unit, int layer) {
  std::int64_t& mark = unit_mark_[static_cast<std::size_t>(unit)];
  const std::int64_t now = (static_cast<std::int64_t>(evaluation_) << 24) + layer + 1;
  if (mark == now) return;
  mark = now;
  const Unit& chosen = layers_.units()[static_cast<std::size_t>(unit)];
  if (chosen.op < 0) return require(chosen.condition, layers_.unit_layer(unit));
  ++steps_;
  cost_ += std::max(0.0, space_.task().operators[static_cast<std::size_t>(chosen.op)].cost.low);
  const int first = layers_.unit_layer(unit);
  std::int32_t& helpful = helpful_mark_[static_cast<std::size_t>(chosen.op)];
  if (first == 0 && helpful != evaluation_) {
    helpful = evaluation_;
    helpful_.push_back(chosen.op);
  }
  require(chosen.condition, first);
}

void RelaxedPlan::achieve_literals(int layer) {
  auto& goals = literal_goals_[static_cast<std::size_t>(layer)];
  for (const int literal : goals) {
    const int unit = layers_.achiever(literal);
    if (unit >= 0) select(unit, layers_.unit_layer(unit));
  }
  goals.clear();
}

double RelaxedPlan::contribution(const Unit& unit, const NumericGoal& goal, bool upwards, int layer) const {
  const std::vector<Interval>& values = layers_.values(layer);
  double sum = 0.0;
  for (const NumericEffect& effect : unit.numeric) {
    const auto term = std::find_if(goal.difference.terms.begin(), goal.difference.terms.end(),
                                   [&](const LinearTerm& t) { return t.variable == effect.variable; });
    if (term == goal.difference.terms.end()) continue;
    const Interval amount = evaluate_interval(effect.amount, values);
    const Interval before = values[static_cast<std::size_t>(effect.variable)];
    if (amount.empty()) continue;
    Interval change = amount;
    if (effect.kind == ChangeKind::Decrease) change = -amount;
    if (effect.kind == ChangeKind::Assign) change = before.empty() ? amount : amount - before;
    if (effect.kind == ChangeKind::ScaleUp) change = before * amount - before;
    if (effect.kind == ChangeKind::ScaleDown) change = before / amount - before;
    if (change.empty()) continue;
    const double best = upwards == (term->coefficient > 0.0) ? change.high : change.low;
    sum += (upwards ? 1.0 : -1.0) * term->coefficient * best;
  }
  return sum;
}

// Units until the gap is closed: the smallest that closes it alone, else the largest and so on.
void RelaxedPlan::achieve(NumericGoal goal, int layer) {
  if (!goal.difference.linear()) return achieve_nonlinear(goal, layer);
  bool upwards = true;
  double missing = gap(goal.relation, evaluate_interval(goal.difference, layers_.values(layer - 1)), upwards);
  std::vector<std::pair<double, int>> units;
  for (const LinearTerm& term : goal.difference.terms) {
    for (const int u : changers_[static_cast<std::size_t>(term.variable)]) {
      if (layers_.unit_layer(u) >= layer) continue;
      const double gain =
          contribution(layers_.units()[static_cast<std::size_t>(u)], goal, upwards, layer - 1);
      if (gain > 0.0) units.emplace_back(gain, u);
    }
  }
  std::sort(units.begin(), units.end());
  units.erase(std::unique(units.begin(), units.end()), units.end());
  double total = 0.0;
  while (missing > total && !units.empty()) {
    auto pick = std::lower_bound(units.begin(), units.end(), std::make_pair(missing - total - 1e-9, -1));
    if (pick == units.end()) --pick;
    total += pick->first;
    select(pick->second, layer - 1);
    units.erase(pick);
  }
  if (total == 0.0 || total == kInfinity) return;
  goal.difference.constant += upwards ? total : -total;
  require_number(std::move(goal.difference), goal.relation, layer - 1);
}

void RelaxedPlan::achieve_nonlinear(const NumericGoal& goal, int layer) {
  for_each_variable(goal.difference, [&](int variable) {
    for (const int u : changers_[static_cast<std::size_t>(variable)]) {
      if (layers_.unit_layer(u) >= layer) continue;
      return select(u, layer - 1);
    }
  });
}

}  // namespace stepwright::pddl
