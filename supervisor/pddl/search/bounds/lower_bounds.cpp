#include "supervisor/pddl/search/bounds/lower_bounds.h"

#include <algorithm>
#include <set>

namespace stepwright::pddl {
namespace {

// Small projections take the costs that few variables explain; large ones see how those variables hang
// together.
constexpr std::size_t kSmallStates = 60;
constexpr std::size_t kLargeStates = 150;
constexpr std::size_t kMostWork = 20000;
// Many goals share what is spent on all.
constexpr std::size_t kMostWorkOfAll = 125000;

// Facts from `derived` on are left out: no operator changes them, so a projection would take them as fixed.
void add_variables(const Condition& condition, int derived, std::set<int>& facts, std::set<int>& variables) {
  for (const int literal : condition.literals) {
    if (literal / 2 < derived) facts.insert(literal / 2);
  }
  for (const Comparison& comparison : condition.comparisons) {
    for_each_variable(comparison.difference, [&](int v) { variables.insert(v); });
  }
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) add_variables(option, derived, facts, variables);
  }
}

Pattern pattern_of(const std::set<int>& facts, const std::set<int>& variables) {
  return {{facts.begin(), facts.end()}, {variables.begin(), variables.end()}};
}

// One seed per part of the goal.
std::vector<Pattern> seeds(const Condition& goal, int derived) {
  std::vector<Pattern> list;
  for (const int literal : goal.literals) {
    if (literal / 2 < derived) list.push_back({{literal / 2}, {}});
  }
  for (const Comparison& comparison : goal.comparisons) {
    std::set<int> variables;
    for_each_variable(comparison.difference, [&](int v) { variables.insert(v); });
    list.push_back(pattern_of({}, variables));
  }
  for (const auto& options : goal.choices) {
    std::set<int> facts, variables;
    for (const Condition& option : options) add_variables(option, derived, facts, variables);
    list.push_back(pattern_of(facts, variables));
  }
  return list;
}

}  // namespace

LowerBounds::LowerBounds(const StateSpace& space, const std::function<bool()>& stop) : space_(space) {
  // The number of goals may be large; the first ones must do then.
  constexpr std::size_t kMostSeeds = 24;
  std::vector<Pattern> list = seeds(space.task().goal, space.task().first_derived);
  if (list.size() > kMostSeeds) list.resize(kMostSeeds);
  most_work_ = std::min(kMostWork, kMostWorkOfAll / std::max<std::size_t>(1, list.size()));
  for (const Pattern& seed : list) {
    if (stop()) break;
    grow_patterns(seed);
  }
  places_.resize(projections_.size());
  add_sums(false, cost_sums_);
  add_sums(true, step_sums_);
}

// Projections that explain much go first, so that they get the operators they need; the best ones are first
// once each.
void LowerBounds::add_sums(bool steps, std::vector<Sum>& sums) const {
  constexpr std::size_t kMostSums = 4;
  const std::vector<Word> initial = space_.initial();
  std::vector<std::pair<double, std::size_t>> ranking;
  for (std::size_t p = 0; p < projections_.size(); ++p) {
    const Sum alone = partition({p}, steps);
    const std::uint32_t place = projections_[p].find(initial.data());
    ranking.emplace_back(-alone.front().distance[place], p);
  }
  std::sort(ranking.begin(), ranking.end());
  std::vector<std::size_t> order;
  for (const auto& [value, p] : ranking) {
    if (value < 0.0) order.push_back(p);
  }
  for (std::size_t first = 0; first < std::min(order.size(), kMostSums); ++first) {
    std::vector<std::size_t> rotated = order;
    std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(first),
                rotated.begin() + static_cast<std::ptrdiff_t>(first) + 1);
    sums.push_back(partition(rotated, steps));
  }
}

void LowerBounds::keep(Projection projection) {
  for (const Projection& other : projections_) {
    if (other.pattern() == projection.pattern()) return;
  }
  projections_.push_back(std::move(projection));
}

// The pattern with everything that the operators on it look at.
Pattern LowerBounds::causes(const Pattern& pattern, const Projection& projection) const {
  std::set<int> facts(pattern.facts.begin(), pattern.facts.end());
  std::set<int> variables(pattern.variables.begin(), pattern.variables.end());
  for (const int i : projection.operators()) {
    const GroundOperator& op = space_.task().operators[static_cast<std::size_t>(i)];
    add_variables(op.precondition, space_.task().first_derived, facts, variables);
    for (const GroundEffect& effect : op.effects) {
      add_variables(effect.when, space_.task().first_derived, facts, variables);
      for (const NumericEffect& numeric : effect.numeric) {
        for_each_variable(numeric.amount, [&](int v) { variables.insert(v); });
      }
      for_each_variable(effect.cost, [&](int v) { variables.insert(v); });
    }
  }
  return pattern_of(facts, variables);
}

void LowerBounds::grow_patterns(const Pattern& seed) {
  std::optional<Projection> small, large;
  Pattern pattern = seed;
  while (auto next = Projection::build(space_, pattern, kLargeStates, most_work_)) {
    if (next->states() <= kSmallStates) small = next;
    large = std::move(next);
    Pattern grown = causes(pattern, *large);
    if (grown == pattern) break;
    pattern = std::move(grown);
  }
  if (small) keep(std::move(*small));
  if (large) keep(std::move(*large));
}

LowerBounds::Sum LowerBounds::partition(const std::vector<std::size_t>& order, bool steps) const {
  std::vector<bool> taken(space_.task().operators.size(), false);
  Sum sum;
  for (const std::size_t p : order) {
    const Projection& projection = projections_[p];
    sum.push_back({p, projection.distances([&](int op, double cost) {
                     if (taken[static_cast<std::size_t>(op)]) return 0.0;
                     return steps ? 1.0 : std::max(0.0, cost);
                   })});
    // An operator without cost may count elsewhere; one with cost counts here only.
    for (const int op : projection.operators()) {
      const Interval cost = space_.task().operators[static_cast<std::size_t>(op)].cost;
      if (steps || cost.high > 0.0) taken[static_cast<std::size_t>(op)] = true;
    }
  }
  return sum;
}

double LowerBounds::evaluate(const Sum& sum, const std::vector<std::uint32_t>& places) const {
  double total = 0.0;
  for (const Table& table : sum) {
    const std::uint32_t place = places[table.projection];
    if (place != kNoNode) total += table.distance[place];
  }
  return total;
}

LowerBound LowerBounds::operator()(const Word* state) const {
  for (std::size_t i = 0; i < projections_.size(); ++i) places_[i] = projections_[i].find(state);
  double cost = 0.0;
  double steps = 0.0;
  for (const Sum& sum : cost_sums_) cost = std::max(cost, evaluate(sum, places_));
  for (const Sum& sum : step_sums_) steps = std::max(steps, evaluate(sum, places_));
  if (cost == kInfinity || steps == kInfinity) return {kInfinity, 0};
  return {cost, static_cast<std::uint32_t>(steps)};
}

}  // namespace stepwright::pddl
