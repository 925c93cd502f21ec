#include "supervisor/pddl/search/astar_search.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "supervisor/pddl/search/gentle_growth.h"
#include "supervisor/pddl/search/plan_runner.h"

namespace stepwright::pddl {

AStarSearch::AStarSearch(const StateSpace& space, SearchControl& control, const LowerBounds& bounds,
                         LandmarkCut* cut)
    : space_(space),
      control_(control),
      bounds_(bounds),
      cut_(cut),
      best_(control),
      memory_(control),
      nodes_(space),
      scratch_(space.words()),
      current_(space.words()),
      least_potential_(evaluate_interval(space.task().potential, space.task().bounds).low) {
  const GroundTask& task = space.task();
  negative_ = std::any_of(task.operators.begin(), task.operators.end(),
                          [](const GroundOperator& op) { return !(op.cost.low >= 0.0); });
  unit_cost_ = task.potential.is_constant() &&
               std::all_of(task.operators.begin(), task.operators.end(),
                           [](const GroundOperator& op) { return op.cost == Interval::point(1.0); });
}

void AStarSearch::push(const Entry& entry) {
  if (!best_().leaves_room_for(entry.key, entry.tie)) return;
  push_gently(open_, entry);
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

void AStarSearch::push(std::uint32_t node, const Word* state) {
  const LowerBound rest = bounds_(state);
  if (rest.cost == kInfinity) return;
  const Node& n = nodes_[node];
  const double cost = negative_ ? -kInfinity : comparable(n.cost + rest.cost + least_potential_);
  double steps = static_cast<double>(n.steps + rest.steps);
  if (unit_cost_) steps = std::max(steps, std::ceil(n.cost + rest.cost - 1e-6));
  push({cost, steps, node, n.steps, n.cost, cut_ == nullptr});
}

// Asks the second bound. False if the entry has to wait for its new turn, or for ever.
bool AStarSearch::refine(Entry entry) {
  if (entry.refined) return true;
  nodes_.load(entry.node, current_.data());
  const double rest = (*cut_)(current_.data());
  if (rest == kInfinity) return false;
  const double key = comparable(entry.cost + rest + least_potential_);
  if (key <= entry.key) return true;
  entry.key = key;
  if (unit_cost_) entry.tie = std::max(entry.tie, std::ceil(entry.cost + rest - 1e-6));
  entry.refined = true;
  push(entry);
  return false;
}

// A goal becomes the incumbent at once; the proof is that nothing on the open list can beat it any more.
void AStarSearch::offer_goal(std::uint32_t node, const Word* state) {
  const double cost = nodes_[node].cost + space_.evaluate(space_.task().potential, state);
  if (!best_().leaves_room_for(comparable(cost), nodes_[node].steps)) return;
  offer_plan(space_, control_, nodes_.path(node));
}

bool AStarSearch::on_path(std::uint32_t node, std::uint32_t ancestor) const {
  for (; node != kNoNode; node = nodes_[node].parent) {
    if (node == ancestor) return true;
  }
  return false;
}

void AStarSearch::successor(std::uint32_t parent, int op, double cost) {
  const double total = snap(nodes_[parent].cost + cost);
  const std::uint32_t steps = nodes_[parent].steps + 1;
  const auto [node, added] = nodes_.insert(scratch_.data());
  Node& n = nodes_[node];
  if (!added) {
    if (n.cost < total || (n.cost == total && n.steps <= steps)) return;
    if (negative_ && on_path(parent, node)) {
      unbounded_ = true;
      return;
    }
  }
  n = {total, parent, op, steps, false};
  if (space_.goal(scratch_.data())) offer_goal(node, scratch_.data());
  push(node, scratch_.data());
}

void AStarSearch::expand(std::uint32_t node) {
  control_.count_expanded(1);
  nodes_[node].closed = true;
  nodes_.load(node, current_.data());
  space_.applicable(current_.data(), applicable_);
  for (const int op : applicable_) {
    double cost = 0.0;
    if (space_.apply(op, current_.data(), scratch_.data(), cost)) successor(node, op, cost);
    if (unbounded_) return;
  }
}

void AStarSearch::start() {
  started_ = true;
  current_ = space_.initial();
  const std::uint32_t root = nodes_.insert(current_.data()).first;
  if (space_.goal(current_.data())) offer_goal(root, current_.data());
  push(root, current_.data());
}

double AStarSearch::bound() {
  if (!started_) return -kInfinity;
  const double best = best_().cost;
  return open_.empty() ? best : std::min(best, open_.front().key);
}

SearchStatus AStarSearch::run(std::uint64_t expansions, StopReason& reason) {
  if (!started_) start();
  const std::uint64_t pause = cut_ == nullptr ? 64 : 4;
  for (std::uint64_t done = 0; done < expansions && !open_.empty(); ++done) {
    if (done % pause == 0) {
      control_.raise_bound(bound());
      memory_.set(nodes_.memory() + open_.capacity() * sizeof(Entry));
      if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
    }
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const Entry entry = open_.back();
    open_.pop_back();
    const Node& node = nodes_[entry.node];
    if (node.steps != entry.steps || node.cost != entry.cost) continue;
    if (!best_().leaves_room_for(entry.key, entry.tie)) {
      // Nothing behind it is worth more.
      open_.clear();
      break;
    }
    if (!refine(entry)) continue;
    expand(entry.node);
    if (unbounded_) return SearchStatus::Stopped;
  }
  if (!open_.empty()) return SearchStatus::Running;
  control_.raise_bound(best_().cost);
  return SearchStatus::Exhausted;
}

}  // namespace stepwright::pddl
