#include "supervisor/pddl/search/landmark_cut.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace stepwright::pddl {
namespace {

constexpr char kUnknown = 0, kGoalZone = 1, kBefore = 2;
constexpr double kNothing = 1e-9;  // costs below this are rounding

}  // namespace

// The goal is one more atom, which one more unit reaches.
LandmarkCut::LandmarkCut(const RelaxedTask& task)
    : task_(task), goal_(task.goal()), goal_atom_(static_cast<int>(task.atoms())) {
  const auto& operators = task.space().task().operators;
  for (const GroundOperator& op : operators) {
    costs_.push_back(std::isfinite(op.cost.low) ? std::max(0.0, op.cost.low) : 0.0);
  }
  costs_.push_back(0.0);
  const std::size_t units = task.units() + 1;
  const auto atoms = static_cast<std::size_t>(goal_atom_) + 1;
  std::vector<std::vector<int>> reaches(units), reached_by(atoms), needed_by(atoms), units_of(costs_.size());
  for (std::size_t u = 0; u < task.units(); ++u) {
    reaches[u].assign(task.adds(u).begin(), task.adds(u).end());
    for (const Mover& mover : task.moved_by(u)) reaches[u].push_back(mover.atom);
    for (const int atom : task.needs(u))
      needed_by[static_cast<std::size_t>(atom)].push_back(static_cast<int>(u));
  }
  reaches.back().push_back(goal_atom_);
  for (const int atom : goal_)
    needed_by[static_cast<std::size_t>(atom)].push_back(static_cast<int>(units) - 1);
  for (std::size_t u = 0; u < units; ++u) {
    for (const int atom : reaches[u])
      reached_by[static_cast<std::size_t>(atom)].push_back(static_cast<int>(u));
    const int op = u + 1 < units ? task.operator_of(u) : -1;
    units_.push_back({op < 0 ? static_cast<int>(operators.size()) : op, 0, -1, 0.0});
    if (op >= 0) units_of[static_cast<std::size_t>(op)].push_back(static_cast<int>(u));
  }
  reaches_ = PackedLists<int>(reaches);
  reached_by_ = PackedLists<int>(reached_by);
  needed_by_ = PackedLists<int>(needed_by);
  units_of_ = PackedLists<int>(units_of);
  in_cut_.assign(costs_.size(), 0);
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
    units_[u].supporter = -1;
    units_[u].supporter_cost = needs == 0 ? 0.0 : kInfinity;
    if (needs > 0) continue;
    for (const int atom : reaches_[u]) improve(atom, cost_of(units_[u]));
  }
  task_.for_each_holding(state, [this](int atom) { improve(atom, 0.0); });
  for (int atom = 0; pop(atom);) {
    const double cost = cost_[static_cast<std::size_t>(atom)];
    for (const int u : needed_by_[static_cast<std::size_t>(atom)]) {
      Unit& unit = units_[static_cast<std::size_t>(u)];
      if (--unit.lacking > 0) continue;
      unit.supporter = atom;  // the last to be reached is the dearest
      unit.supporter_cost = cost;
      for (const int reached : reaches_[static_cast<std::size_t>(u)]) improve(reached, cost + cost_of(unit));
    }
  }
}

void LandmarkCut::find_supporter(Unit& unit, std::size_t index) {
  const std::span<const int> needs = index < task_.units() ? task_.needs(index) : std::span<const int>(goal_);
  for (const int atom : needs) {
    if (cost_[static_cast<std::size_t>(atom)] > cost_[static_cast<std::size_t>(unit.supporter)])
      unit.supporter = atom;
  }
  unit.supporter_cost = cost_[static_cast<std::size_t>(unit.supporter)];
}

// After the operators of the cut have become cheaper: costs fall, and only what they touch is worked out
// anew.
void LandmarkCut::explore_again() {
  heap_.clear();
  for (const int op : cut_) {
    for (const int u : units_of_[static_cast<std::size_t>(op)]) {
      const Unit& unit = units_[static_cast<std::size_t>(u)];
      if (unit.supporter_cost == kInfinity) continue;
      for (const int atom : reaches_[static_cast<std::size_t>(u)])
        improve(atom, unit.supporter_cost + cost_of(unit));
    }
  }
  for (int atom = 0; pop(atom);) {
    for (const int u : needed_by_[static_cast<std::size_t>(atom)]) {
      Unit& unit = units_[static_cast<std::size_t>(u)];
      if (unit.supporter != atom || unit.supporter_cost <= cost_[static_cast<std::size_t>(atom)]) continue;
      find_supporter(unit, static_cast<std::size_t>(u));
      for (const int reached : reaches_[static_cast<std::size_t>(u)]) {
        improve(reached, unit.supporter_cost + cost_of(unit));
      }
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
      if (unit.supporter < 0 || cost_of(unit) > kNothing) continue;
      char& zone = zone_[static_cast<std::size_t>(unit.supporter)];
      if (zone != kUnknown) continue;
      zone = kGoalZone;
      stack_.push_back(unit.supporter);
    }
  }
}

// The operators that lead into the goal zone from what the state reaches without it; the least of their
// costs.
double LandmarkCut::find_cut(const Word* state) {
  cut_.clear();
  double least = kInfinity;
  const auto enter = [&](int u) {
    const Unit& unit = units_[static_cast<std::size_t>(u)];
    const std::span<const int> reached = reaches_[static_cast<std::size_t>(u)];
    const bool crosses = std::any_of(reached.begin(), reached.end(), [&](int atom) {
      return zone_[static_cast<std::size_t>(atom)] == kGoalZone;
    });
    if (crosses) {
      least = std::min(least, cost_of(unit));
      if (!in_cut_[static_cast<std::size_t>(unit.op)]) {
        in_cut_[static_cast<std::size_t>(unit.op)] = 1;
        cut_.push_back(unit.op);
      }
      return;
    }
    for (const int atom : reached) {
      if (zone_[static_cast<std::size_t>(atom)] != kUnknown) continue;
      zone_[static_cast<std::size_t>(atom)] = kBefore;
      stack_.push_back(atom);
    }
  };
  task_.for_each_holding(state, [&](int atom) {
    if (zone_[static_cast<std::size_t>(atom)] != kUnknown) return;
    zone_[static_cast<std::size_t>(atom)] = kBefore;
    stack_.push_back(atom);
  });
  for (const int u : task_.without_needs()) enter(u);
  while (!stack_.empty()) {
    const int atom = stack_.back();
    stack_.pop_back();
    for (const int u : needed_by_[static_cast<std::size_t>(atom)]) {
      if (units_[static_cast<std::size_t>(u)].supporter == atom) enter(u);
    }
  }
  for (const int op : cut_) in_cut_[static_cast<std::size_t>(op)] = 0;
  return least;
}

double LandmarkCut::operator()(const Word* state) {
  remaining_ = costs_;
  explore(state);
  const auto goal = static_cast<std::size_t>(goal_atom_);
  if (cost_[goal] == kInfinity) return kInfinity;
  double total = 0.0;
  while (cost_[goal] > kNothing) {
    zone_.assign(goal + 1, kUnknown);
    mark_goal_zone(goal_atom_);
    const double least = find_cut(state);
    // A cut that is empty or free is rounding: what has been counted stands.
    if (cut_.empty() || !(least > kNothing) || least == kInfinity) break;
    total += least;
    for (const int op : cut_) remaining_[static_cast<std::size_t>(op)] -= least;
    explore_again();
  }
  return total;
}

}  // namespace stepwright::pddl
