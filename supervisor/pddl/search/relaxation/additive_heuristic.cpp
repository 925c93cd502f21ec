#include "supervisor/pddl/search/relaxation/additive_heuristic.h"

#include <algorithm>
#include <cmath>

namespace stepwright::pddl {

namespace {

// NaN if it is undefined.
double cost_in(const StateSpace& space, const GroundOperator& op, const Word* state) {
  double cost = 0.0;
  for (const GroundEffect& effect : op.effects) {
    if (effect.when.always() || space.holds(effect.when, state)) cost += space.evaluate(effect.cost, state);
  }
  return cost;
}

}  // namespace

int OperatorWeights::weight(double cost) const {
  if (scale == 0.0) return 1;
  return 1 + (std::isfinite(cost) ? static_cast<int>(std::clamp(scale * cost, 0.0, 10'000.0)) : 0);
}

OperatorWeights unit_weights(const GroundTask& task) {
  return {std::vector<int>(task.operators.size(), 1), 0.0};
}

OperatorWeights cost_weights(const GroundTask& task) {
  // Those whose least cost is nothing tell the scale only if there are no others.
  for (const bool least : {true, false}) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const GroundOperator& op : task.operators) {
      const double cost = least ? op.cost.low : op.cost.high;
      if (!(cost > 0.0) || !std::isfinite(cost)) continue;
      sum += cost;
      ++count;
    }
    if (count == 0) continue;
    OperatorWeights weights{{}, 20.0 * static_cast<double>(count) / sum};
    for (const GroundOperator& op : task.operators) weights.of.push_back(weights.weight(op.cost.low));
    return weights;
  }
  return unit_weights(task);
}

AdditiveHeuristic::AdditiveHeuristic(const RelaxedTask& task, OperatorWeights weights)
    : task_(task), weights_(std::move(weights)), goal_(task.goal()) {
  for (std::size_t u = 0; u < task.units(); ++u) {
    const int op = task.operator_of(u);
    const int weight = op < 0 ? 0 : weights_.of[static_cast<std::size_t>(op)];
    fresh_units_.push_back({static_cast<int>(task.needs(u).size()), 0, weight});
  }
  atoms_.resize(task.atoms());
  is_goal_.resize(task.atoms());
  wanted_.assign(task.atoms(), 0);
  used_.assign(task.units(), 0);
  place_.resize(task.units());
  helpful_mark_.assign(weights_.of.size(), 0);
  if (weights_.scale > 0.0) find_varying();
}

void AdditiveHeuristic::find_varying() {
  const auto& operators = task_.space().task().operators;
  std::vector<int> place(operators.size(), -1);
  for (std::size_t u = 0; u < task_.units(); ++u) {
    const int op = task_.operator_of(u);
    if (op < 0) continue;
    const Interval cost = operators[static_cast<std::size_t>(op)].cost;
    if (cost.low == cost.high) continue;
    int& p = place[static_cast<std::size_t>(op)];
    if (p < 0) {
      p = static_cast<int>(varying_.size());
      varying_.push_back({op, {}});
    }
    varying_[static_cast<std::size_t>(p)].units.push_back(static_cast<int>(u));
  }
}

// Weighs what depends on the state.
void AdditiveHeuristic::weigh() {
  const StateSpace& space = task_.space();
  for (const Varying& varying : varying_) {
    const auto op = static_cast<std::size_t>(varying.op);
    const int weight = weights_.weight(cost_in(space, space.task().operators[op], state_));
    if (weight == weights_.of[op]) continue;
    weights_.of[op] = weight;
    for (const int unit : varying.units) fresh_units_[static_cast<std::size_t>(unit)].weight = weight;
  }
}

void AdditiveHeuristic::aim(std::vector<int> atoms, std::vector<Comparison> comparisons) {
  goal_ = std::move(atoms);
  targets_ = std::move(comparisons);
  std::vector<std::vector<Mover>> by_unit(targets_.empty() ? 0 : task_.units());
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const auto atom = static_cast<int>(task_.atoms() + i);
    goal_.push_back(atom);
    for (const Mover& mover : task_.movers_towards(targets_[i], atom)) {
      by_unit[static_cast<std::size_t>(mover.unit)].push_back(mover);
    }
  }
  towards_ = PackedLists<Mover>(by_unit);
  atoms_.resize(task_.atoms() + targets_.size());
  is_goal_.assign(atoms_.size(), false);
  wanted_.resize(atoms_.size(), 0);
}

const Comparison& AdditiveHeuristic::comparison(int atom) const {
  const auto a = static_cast<std::size_t>(atom);
  return a < task_.atoms() ? task_.comparison(a - task_.first_comparison()) : targets_[a - task_.atoms()];
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
  const Comparison& target = comparison(mover.atom);
  const Gap gap = gap_of(target.relation, task_.space().evaluate(target.difference, state_));
  if (gap.upwards ? !(mover.gain.high > 0.0) : !(mover.gain.low < 0.0)) {
    if (gap.distance < kInfinity) return;
  }
  const double gain = task_.gain(mover, target, state_) * (gap.upwards ? 1.0 : -1.0);
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
  if (!targets_.empty()) {
    for (const Mover& mover : towards_[u]) move(mover);
  }
}

void AdditiveHeuristic::start(const Word* without) {
  weigh();
  queue_.clear();
  std::fill(atoms_.begin(), atoms_.end(), AtomEntry{kFar, -1, 0, false});
  units_ = fresh_units_;
  for (const int atom : goal_) is_goal_[static_cast<std::size_t>(atom)] = true;
  task_.for_each_holding(
      state_, [this](int atom) { reach(atom, 0, -1, 0); }, without);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (task_.space().holds(targets_[i], state_)) reach(static_cast<int>(task_.atoms() + i), 0, -1, 0);
  }
  for (const int unit : task_.without_needs()) fire(unit);
}

bool AdditiveHeuristic::propagate() {
  std::size_t goals = goal_.size();
  while (goals > 0 && !queue_.empty()) {
    const int atom = queue_.pop();
    AtomEntry& entry = atoms_[static_cast<std::size_t>(atom)];
    if (entry.closed) continue;
    entry.closed = true;
    if (is_goal_[static_cast<std::size_t>(atom)]) --goals;
    if (static_cast<std::size_t>(atom) >= task_.atoms()) continue;
    for (const int unit : task_.needed_by(static_cast<std::size_t>(atom))) {
      UnitEntry& waiting = units_[static_cast<std::size_t>(unit)];
      waiting.needs_cost = std::min(waiting.needs_cost + entry.cost, 100'000'000);
      if (--waiting.lacking == 0) fire(unit);
    }
  }
  return goals == 0;
}

bool AdditiveHeuristic::evaluate(const Word* state, const Word* without) {
  state_ = state;
  start(without);
  const bool reached = propagate();
  for (const int atom : goal_) is_goal_[static_cast<std::size_t>(atom)] = false;
  if (reached) extract();
  return reached;
}

void AdditiveHeuristic::want(int atom) {
  int& mark = wanted_[static_cast<std::size_t>(atom)];
  if (mark == evaluation_) return;
  mark = evaluation_;
  if (atoms_[static_cast<std::size_t>(atom)].unit >= 0) stack_.push_back(atom);
}

// A unit that several atoms want is applied as often as the one that wants most of it.
void AdditiveHeuristic::extract() {
  ++evaluation_;
  plan_.clear();
  helpful_.clear();
  for (const int atom : goal_) want(atom);
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
    estimate_ += use.times * weights_.of[static_cast<std::size_t>(use.op)];
  }
}

}  // namespace stepwright::pddl
