#include "supervisor/pddl/search/bounds/landmark_cut.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "supervisor/pddl/search/bounds/operator_gains.h"
#include "supervisor/pddl/search/space/integer_ranges.h"

namespace stepwright::pddl {
namespace {

constexpr char kUnknown = 0, kGoalZone = 1, kBefore = 2;
constexpr double kNothing = 1e-9;  // costs below this are rounding

}  // namespace

// The goal is one more atom, which one more unit reaches.
LandmarkCut::LandmarkCut(const RelaxedTask& task, std::function<bool()> stop)
    : task_(task), stop_(std::move(stop)), goal_(task.goal()), goal_atom_(static_cast<int>(task.atoms())) {
  const GroundTask& ground = task.space().task();
  for (const GroundOperator& op : ground.operators) {
    costs_.push_back(std::isfinite(op.cost.low) ? std::max(0.0, op.cost.low) : 0.0);
  }
  unit_ = common_unit(costs_);
  weight_.assign(costs_.size(), 0.0);
  const std::vector<bool> integers = integer_variables(ground);
  for (std::size_t c = 0; c < task.comparisons(); ++c) {
    integer_.push_back(is_integer(task.comparison(c).difference, integers));
  }
  connect(task);
}

void LandmarkCut::connect(const RelaxedTask& task) {
  const std::size_t units = task.units() + 1;
  const auto atoms = static_cast<std::size_t>(goal_atom_) + 1;
  const OperatorGains gains(task);
  alike_up_ = gains.alike(true);
  alike_down_ = gains.alike(false);
  std::vector<std::vector<Reach>> numbers(units);
  std::vector<std::vector<int>> reaches(units), reached_by(atoms), needed_by(atoms), units_of(costs_.size());
  for (std::size_t u = 0; u < task.units(); ++u) {
    reaches[u].assign(task.adds(u).begin(), task.adds(u).end());
    for (const Mover& mover : task.moved_by(u)) {
      const Gains gain = gains.of(mover);
      numbers[u].push_back({mover.atom, gain.up, gain.down});
    }
    for (const int atom : task.needs(u))
      needed_by[static_cast<std::size_t>(atom)].push_back(static_cast<int>(u));
  }
  reaches.back().push_back(goal_atom_);
  for (const int atom : goal_)
    needed_by[static_cast<std::size_t>(atom)].push_back(static_cast<int>(units) - 1);
  for (std::size_t u = 0; u < units; ++u) {
    for (const int atom : reaches[u])
      reached_by[static_cast<std::size_t>(atom)].push_back(static_cast<int>(u));
    for (const Reach& reach : numbers[u])
      reached_by[static_cast<std::size_t>(reach.atom)].push_back(static_cast<int>(u));
    const int op = u + 1 < units ? task.operator_of(u) : -1;
    units_.push_back({op < 0 ? static_cast<int>(costs_.size()) : op, 0, 0.0});
    if (op >= 0) units_of[static_cast<std::size_t>(op)].push_back(static_cast<int>(u));
  }
  reached_atoms_ = PackedLists<int>(reaches);
  reached_numbers_ = PackedLists<Reach>(numbers);
  supporter_.assign(units, -1);
  reached_by_ = PackedLists<int>(reached_by);
  needed_by_ = PackedLists<int>(needed_by);
  units_of_ = PackedLists<int>(units_of);
}

// How far every comparison is from holding. Above zero means at least 1 where all values are integers.
void LandmarkCut::measure_gaps(const Word* state) {
  const StateSpace& space = task_.space();
  gaps_.resize(task_.comparisons());
  for (std::size_t c = 0; c < gaps_.size(); ++c) {
    const Comparison& comparison = task_.comparison(c);
    Gap& gap = gaps_[c];
    gap = gap_of(comparison.relation, space.evaluate(comparison.difference, state));
    const bool strict = comparison.relation == Relation::Less || comparison.relation == Relation::Greater;
    if (strict && integer_[c]) gap.distance = std::floor(gap.distance) + 1.0;
    // Comparisons allow for rounding.
    if (!integer_[c]) gap.distance -= kNothing;
  }
}

// How many applications of a unit's operator alone reach the atom: at least 1, kInfinity if it cannot.
double LandmarkCut::applications(const Reach& reach) const {
  const auto c = static_cast<std::size_t>(reach.atom) - task_.first_comparison();
  const Gap& gap = gaps_[c];
  const double gain = gap.upwards ? reach.up : reach.down;
  if (!(gain > 0.0)) return gap.distance == kInfinity ? 1.0 : kInfinity;
  if (gain == kInfinity || gap.distance == kInfinity || gap.distance <= gain) return 1.0;
  const double alike = gap.upwards ? alike_up_[c] : alike_down_[c];
  return alike > 0.0 ? std::ceil(gap.distance / alike - 1e-6) : gap.distance / gain;
}

double LandmarkCut::cost_of(const Unit& unit, const Reach& reach) const {
  const double cost = cost_of(unit), times = applications(reach);
  return times == kInfinity ? kInfinity : cost * times;
}

// Tells the atoms that a unit reaches what they cost by it.
void LandmarkCut::spread(std::size_t unit) {
  const double before = units_[unit].supporter_cost, after = before + cost_of(units_[unit]);
  for (const int atom : reached_atoms_[unit]) improve(atom, after);
  for (const Reach& reach : reached_numbers_[unit])
    improve(reach.atom, before + cost_of(units_[unit], reach));
}

void LandmarkCut::improve(int atom, double cost) {
  double& now = cost_[static_cast<std::size_t>(atom)];
  if (cost >= now) return;
  now = cost;
  heap_.push_back({cost, atom});
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

bool LandmarkCut::pop(int& atom) {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const Entry entry = heap_.back();
    heap_.pop_back();
    atom = entry.atom;
    if (entry.cost == cost_[static_cast<std::size_t>(atom)]) return true;
  }
  return false;
}

// The costs of all atoms when a unit costs as much as the dearest of its needs and itself.
void LandmarkCut::explore(const Word* state) {
  cost_.assign(static_cast<std::size_t>(goal_atom_) + 1, kInfinity);
  heap_.clear();
  for (std::size_t u = 0; u < units_.size(); ++u) {
    const std::size_t needs = u < task_.units() ? task_.needs(u).size() : goal_.size();
    units_[u].lacking = static_cast<int>(needs);
    supporter_[u] = -1;
    units_[u].supporter_cost = needs == 0 ? 0.0 : kInfinity;
    if (needs > 0) continue;
    spread(u);
  }
  task_.for_each_holding(state, [this](int atom) { improve(atom, 0.0); });
  for (int atom = 0; pop(atom);) {
    const double cost = cost_[static_cast<std::size_t>(atom)];
    for (const int u : needed_by_[static_cast<std::size_t>(atom)]) {
      Unit& unit = units_[static_cast<std::size_t>(u)];
      if (--unit.lacking > 0) continue;
      supporter_[static_cast<std::size_t>(u)] = atom;  // the last to be reached is the dearest
      unit.supporter_cost = cost;
      spread(static_cast<std::size_t>(u));
    }
  }
}

void LandmarkCut::find_supporter(std::size_t unit) {
  const std::span<const int> needs = unit < task_.units() ? task_.needs(unit) : std::span<const int>(goal_);
  int& supporter = supporter_[unit];
  for (const int atom : needs) {
    if (cost_[static_cast<std::size_t>(atom)] > cost_[static_cast<std::size_t>(supporter)]) supporter = atom;
  }
  units_[unit].supporter_cost = cost_[static_cast<std::size_t>(supporter)];
}

// After the operators of the cut have become cheaper: costs fall, and only what they touch is worked out
// anew.
void LandmarkCut::explore_again() {
  heap_.clear();
  for (const int op : cut_.operators) {
    for (const int u : units_of_[static_cast<std::size_t>(op)]) {
      if (units_[static_cast<std::size_t>(u)].supporter_cost < kInfinity) spread(static_cast<std::size_t>(u));
    }
  }
  for (int atom = 0; pop(atom);) {
    for (const int u : needed_by_[static_cast<std::size_t>(atom)]) {
      if (supporter_[static_cast<std::size_t>(u)] != atom) continue;
      if (units_[static_cast<std::size_t>(u)].supporter_cost <= cost_[static_cast<std::size_t>(atom)])
        continue;
      find_supporter(static_cast<std::size_t>(u));
      spread(static_cast<std::size_t>(u));
    }
  }
}

// All atoms from which the goal is reached along supporters for nothing.
void LandmarkCut::mark_goal_zone(int atom) {
  zone_[static_cast<std::size_t>(atom)] = kGoalZone;
  stack_.push_back(atom);
  while (!stack_.empty()) {
    const int next = stack_.back();
    stack_.pop_back();
    for (const int u : reached_by_[static_cast<std::size_t>(next)]) {
      const Unit& unit = units_[static_cast<std::size_t>(u)];
      const int supporter = supporter_[static_cast<std::size_t>(u)];
      if (supporter < 0 || cost_of(unit) > kNothing || !leads(u, next)) continue;
      char& zone = zone_[static_cast<std::size_t>(supporter)];
      if (zone != kUnknown) continue;
      zone = kGoalZone;
      stack_.push_back(supporter);
    }
  }
}

// Does the unit bring the atom nearer in this state?
bool LandmarkCut::leads(int unit, int atom) const {
  if (static_cast<std::size_t>(atom) < task_.first_comparison()) return true;
  const std::span<const Reach> reached = reached_numbers_[static_cast<std::size_t>(unit)];
  const auto c = static_cast<std::size_t>(atom) - task_.first_comparison();
  return c >= gaps_.size() || std::any_of(reached.begin(), reached.end(), [&](const Reach& reach) {
           return reach.atom == atom && applications(reach) < kInfinity;
         });
}

// The operator takes part in the cut.
void LandmarkCut::enter_operator(int op, double weight) {
  // The unit of the goal belongs to no operator: nothing could be paid.
  if (static_cast<std::size_t>(op) >= weight_.size()) return;
  double& known = weight_[static_cast<std::size_t>(op)];
  if (known == 0.0) cut_.operators.push_back(op);
  known = std::max(known, weight);
}

void LandmarkCut::enter_before(int atom) {
  zone_[static_cast<std::size_t>(atom)] = kBefore;
  stack_.push_back(atom);
}

// A unit whose dearest need is reached without the goal zone: either it leads there, or further on before it.
void LandmarkCut::enter(std::size_t index) {
  for (const int atom : reached_atoms_[index]) {
    const char zone = zone_[static_cast<std::size_t>(atom)];
    if (zone == kGoalZone) enter_operator(units_[index].op, 1.0);
    if (zone == kUnknown) enter_before(atom);
  }
  for (const Reach& reach : reached_numbers_[index]) {
    const char zone = zone_[static_cast<std::size_t>(reach.atom)];
    if (zone == kBefore) continue;
    const double times = applications(reach);
    if (times == kInfinity) continue;
    if (zone == kGoalZone) enter_operator(units_[index].op, 1.0 / times);
    if (zone == kUnknown) enter_before(reach.atom);
  }
}

// The operators that lead into the goal zone from what the state reaches without it.
void LandmarkCut::find_cut(const Word* state) {
  cut_.operators.clear();
  cut_.weights.clear();
  task_.for_each_holding(state, [&](int atom) {
    if (zone_[static_cast<std::size_t>(atom)] != kUnknown) return;
    zone_[static_cast<std::size_t>(atom)] = kBefore;
    stack_.push_back(atom);
  });
  for (const int u : task_.without_needs()) enter(static_cast<std::size_t>(u));
  while (!stack_.empty()) {
    const int atom = stack_.back();
    stack_.pop_back();
    for (const int u : needed_by_[static_cast<std::size_t>(atom)]) {
      if (supporter_[static_cast<std::size_t>(u)] == atom) enter(static_cast<std::size_t>(u));
    }
  }
  for (const int op : cut_.operators) {
    double& weight = weight_[static_cast<std::size_t>(op)];
    cut_.weights.push_back(weight);
    weight = 0.0;
  }
}

// Every operator of the cut gives its share of what the cut is worth.
double LandmarkCut::pay_cut() {
  double worth = kInfinity;
  for (std::size_t i = 0; i < cut_.operators.size(); ++i) {
    worth = std::min(worth, remaining_[static_cast<std::size_t>(cut_.operators[i])] / cut_.weights[i]);
  }
  // A cut that is empty or free is rounding: what has been counted stands.
  if (!(worth > kNothing) || worth == kInfinity) return 0.0;
  for (std::size_t i = 0; i < cut_.operators.size(); ++i) {
    double& rest = remaining_[static_cast<std::size_t>(cut_.operators[i])];
    rest = std::max(0.0, rest - worth * cut_.weights[i]);
  }
  return worth;
}

double LandmarkCut::bound(const Word* state, std::span<const double> costs,
                          const std::function<void(const OperatorLandmark&)>* found) {
  remaining_.assign(costs.begin(), costs.end());
  remaining_.push_back(0.0);
  measure_gaps(state);
  explore(state);
  const auto goal = static_cast<std::size_t>(goal_atom_);
  if (cost_[goal] == kInfinity) return kInfinity;
  double total = 0.0;
  while (cost_[goal] > kNothing) {
    zone_.assign(goal + 1, kUnknown);
    mark_goal_zone(goal_atom_);
    find_cut(state);
    const double worth = pay_cut();
    if (worth == 0.0) break;
    total += worth;
    if (found != nullptr) (*found)(cut_);
    if (stop_ && stop_()) break;
    explore_again();
  }
  return total;
}

}  // namespace stepwright::pddl
