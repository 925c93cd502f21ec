#include "supervisor/pddl/search/additive_heuristic.h"

#include <algorithm>
#include <cmath>

namespace stepwright::pddl {

std::vector<int> unit_weights(const GroundTask& task) {
  return std::vector<int>(task.operators.size(), 1);
}

std::vector<int> cost_weights(const GroundTask& task) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const GroundOperator& op : task.operators) {
    if (!(op.cost.low > 0.0) || !std::isfinite(op.cost.low)) continue;
    sum += op.cost.low;
    ++count;
  }
  if (count == 0) return unit_weights(task);
  const double scale = 20.0 * static_cast<double>(count) / sum;
  std::vector<int> weights;
  for (const GroundOperator& op : task.operators) {
    const double cost = std::isfinite(op.cost.low) ? std::max(0.0, op.cost.low) : 0.0;
    weights.push_back(1 + static_cast<int>(std::min(10'000.0, scale * cost)));
  }
  return weights;
}

double weight_scale(const GroundTask& task, const std::vector<int>& weights) {
  double cost = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(task.operators[i].cost.low > 0.0) || !std::isfinite(task.operators[i].cost.low)) continue;
    cost += task.operators[i].cost.low;
    weight += weights[i] - 1;
  }
  return cost > 0.0 && weight > 0.0 ? weight / cost : 0.0;
}

AdditiveHeuristic::AdditiveHeuristic(const RelaxedTask& task, std::vector<int> weights)
    : task_(task), weights_(std::move(weights)) {
  for (std::size_t u = 0; u < task.units(); ++u) {
    const int op = task.operator_of(u);
    const int weight = op < 0 ? 0 : weights_[static_cast<std::size_t>(op)];
    fresh_units_.push_back({static_cast<int>(task.needs(u).size()), 0, weight});
  }
  atoms_.resize(task.atoms());
  is_goal_.resize(task.atoms());
  wanted_.assign(task.atoms(), 0);
  used_.assign(task.units(), 0);
  place_.resize(task.units());
  helpful_mark_.assign(weights_.size(), 0);
}

void AdditiveHeuristic::reach(int atom, int cost, int unit, int times) {
  AtomEntry& entry = atoms_[static_cast<std::size_t>(atom)];
  if (entry.closed || cost >= entry.cost) return;
  entry.cost = cost;
  entry.unit = unit;
  entry.times = times;
  queue_.push(cost, atom);
}

// Repeats the unit until the gap is closed. What a unit gains may depend on the state; if it gains nothing
// now but can elsewhere, one application must do.
void AdditiveHeuristic::move(const Mover& mover) {
  const AtomEntry& entry = atoms_[static_cast<std::size_t>(mover.atom)];
  if (entry.closed) return;
  const Comparison& comparison =
      task_.comparison(static_cast<std::size_t>(mover.atom) - task_.first_comparison());
  const Gap gap = gap_of(comparison.relation, task_.space().evaluate(comparison.difference, state_));
  if (gap.upwards ? !(mover.gain.high > 0.0) : !(mover.gain.low < 0.0)) {
    if (gap.distance < kInfinity) return;
  }
  const double gain = task_.gain(mover, state_) * (gap.upwards ? 1.0 : -1.0);
  double times = 1.0;
  if (gain > 0.0 && gap.distance < kInfinity) times = std::ceil(gap.distance / gain - 1e-6);
  const int count = static_cast<int>(std::clamp(times, 1.0, 100'000.0));
  const UnitEntry& unit = units_[static_cast<std::size_t>(mover.unit)];
  const double cost = unit.needs_cost + static_cast<double>(count) * unit.weight;
  reach(mover.atom, static_cast<int>(std::min(cost, 1e8)), mover.unit, count);
}

void AdditiveHeuristic::fire(int unit) {
  const auto u = static_cast<std::size_t>(unit);
  const int cost = units_[u].needs_cost + units_[u].weight;
  for (const int atom : task_.adds(u)) reach(atom, cost, unit, 1);
  for (const Mover& mover : task_.moved_by(u)) move(mover);
}

void AdditiveHeuristic::start(const Word* state, const std::vector<int>& goal) {
  state_ = state;
  queue_.clear();
  std::fill(atoms_.begin(), atoms_.end(), AtomEntry{kFar, -1, 0, false});
  units_ = fresh_units_;
  for (const int atom : goal) is_goal_[static_cast<std::size_t>(atom)] = true;
  task_.for_each_holding(state, [this](int atom) { reach(atom, 0, -1, 0); });
  for (const int unit : task_.without_needs()) fire(unit);
}

bool AdditiveHeuristic::propagate(std::size_t goals) {
  while (goals > 0 && !queue_.empty()) {
    const int atom = queue_.pop();
    AtomEntry& entry = atoms_[static_cast<std::size_t>(atom)];
    if (entry.closed) continue;
    entry.closed = true;
    if (is_goal_[static_cast<std::size_t>(atom)]) --goals;
    for (const int unit : task_.needed_by(static_cast<std::size_t>(atom))) {
      UnitEntry& waiting = units_[static_cast<std::size_t>(unit)];
      waiting.needs_cost = std::min(waiting.needs_cost + entry.cost, 100'000'000);
      if (--waiting.lacking == 0) fire(unit);
    }
  }
  return goals == 0;
}

bool AdditiveHeuristic::evaluate(const Word* state, const std::vector<int>& goal) {
  start(state, goal);
  const bool reached = propagate(goal.size());
  for (const int atom : goal) is_goal_[static_cast<std::size_t>(atom)] = false;
  if (reached) extract(goal);
  return reached;
}

void AdditiveHeuristic::want(int atom) {
  int& mark = wanted_[static_cast<std::size_t>(atom)];
  if (mark == evaluation_) return;
  mark = evaluation_;
  if (atoms_[static_cast<std::size_t>(atom)].unit >= 0) stack_.push_back(atom);
}

// A unit that several atoms want is applied as often as the one that wants most of it.
void AdditiveHeuristic::extract(const std::vector<int>& goal) {
  ++evaluation_;
  plan_.clear();
  helpful_.clear();
  for (const int atom : goal) want(atom);
  while (!stack_.empty()) {
    const AtomEntry& entry = atoms_[static_cast<std::size_t>(stack_.back())];
    stack_.pop_back();
    const auto u = static_cast<std::size_t>(entry.unit);
    const int op = task_.operator_of(u);
    if (used_[u] == evaluation_) {
      if (op >= 0) {
        Use& use = plan_[static_cast<std::size_t>(place_[u])];
        use.times = std::max(use.times, entry.times);
      }
      continue;
    }
    used_[u] = evaluation_;
    for (const int need : task_.needs(u)) want(need);
    if (op < 0) continue;
    place_[u] = static_cast<int>(plan_.size());
    plan_.push_back({op, entry.times, units_[u].needs_cost});
    int& mark = helpful_mark_[static_cast<std::size_t>(op)];
    if (units_[u].needs_cost == 0 && mark != evaluation_) {
      mark = evaluation_;
      helpful_.push_back(op);
    }
  }
  estimate_ = steps_ = 0;
  for (const Use& use : plan_) {
    steps_ += use.times;
    estimate_ += use.times * weights_[static_cast<std::size_t>(use.op)];
  }
}

}  // namespace stepwright::pddl
