#include "supervisor/pddl/search/astar_search.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace stepwright::pddl {

AStarSearch::AStarSearch(const StateSpace& space, SearchControl& control, const LowerBounds& bounds,
                         double weight)
    : space_(space),
      control_(control),
      bounds_(bounds),
      weight_(weight),
      heuristic_(space),
      nodes_(space.words()),
      scratch_(space.words()),
      current_(space.words()),
      least_potential_(evaluate_interval(space.task().potential, space.task().bounds).low) {
  const auto& operators = space.task().operators;
  negative_ = std::any_of(operators.begin(), operators.end(),
                          [](const GroundOperator& op) { return !(op.cost.low >= 0.0); });
  const Incumbent& best = control.best();
  if (best.cost < kInfinity && best.steps > 0) {
    step_price_ = std::max(1e-3, std::abs(best.cost) / (10.0 * static_cast<double>(best.steps)));
  }
}

std::size_t AStarSearch::memory() const {
  return nodes_.memory() + open_.capacity() * sizeof(Entry);
}

bool AStarSearch::worth(double cost_bound, double steps_bound) const {
  const Incumbent& best = control_.best();
  if (best.steps == UINT32_MAX) return true;
  return cost_bound < best.cost || (cost_bound == best.cost && steps_bound < static_cast<double>(best.steps));
}

void AStarSearch::push(std::uint32_t node) {
  const LowerBound rest = bounds_(nodes_.state(node));
  if (rest.cost == kInfinity) return;
  const Node& n = nodes_[node];
  const double cost_bound = negative_ ? -kInfinity : comparable(n.cost + rest.cost + least_potential_);
  const double steps_bound = static_cast<double>(n.steps + rest.steps);
  if (!worth(cost_bound, steps_bound)) return;
  Entry entry{cost_bound, steps_bound, cost_bound, node, n.steps, n.cost};
  if (weight_ > 0.0) {
    if (!heuristic_.evaluate(nodes_.state(node))) return;
    const double rest_cost = std::max(rest.cost, heuristic_.cost()) + step_price_ * heuristic_.steps();
    entry.key = n.cost + step_price_ * n.steps + weight_ * rest_cost;
  }
  open_.push_back(entry);
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

// A goal becomes the incumbent at once; the proof is that nothing on the open list can beat it any more.
void AStarSearch::push_goal(std::uint32_t node) {
  const Node& n = nodes_[node];
  const double cost = n.cost + space_.evaluate(space_.task().potential, nodes_.state(node));
  improved_ = control_.offer(nodes_.path(node), cost, n.steps) || improved_;
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
  if (space_.goal(nodes_.state(node))) push_goal(node);
  push(node);
}

void AStarSearch::expand(std::uint32_t node) {
  ++control_.expanded;
  nodes_[node].closed = true;
  std::copy(nodes_.state(node), nodes_.state(node) + space_.words(), current_.begin());
  space_.applicable(current_.data(), applicable_);
  for (const int op : applicable_) {
    double cost = 0.0;
    const GroundOperator& applied = space_.task().operators[static_cast<std::size_t>(op)];
    if (space_.apply(applied, current_.data(), scratch_.data(), cost)) successor(node, op, cost);
    if (unbounded_) return;
  }
}

void AStarSearch::start() {
  started_ = true;
  const std::vector<Word> initial = space_.initial();
  const auto [root, added] = nodes_.insert(initial.data());
  if (space_.goal(nodes_.state(root))) push_goal(root);
  push(root);
}

double AStarSearch::bound() const {
  const double best = control_.best().cost;
  if (weight_ > 0.0) return -kInfinity;
  if (!started_) return -kInfinity;
  return open_.empty() ? best : std::min(best, open_.front().cost_bound);
}

SearchStatus AStarSearch::run(std::uint64_t expansions, StopReason& reason) {
  if (!started_) start();
  improved_ = false;
  for (std::uint64_t done = 0; done < expansions && !open_.empty(); ++done) {
    if (done % 128 == 0) {
      if (weight_ == 0.0) control_.bound = std::max(control_.bound, bound());
      if ((reason = control_.check(memory())) != StopReason::None) return SearchStatus::Stopped;
    }
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const Entry entry = open_.back();
    open_.pop_back();
    const Node& node = nodes_[entry.node];
    if (node.steps != entry.steps || node.cost != entry.cost) continue;
    if (!worth(entry.cost_bound, entry.tie)) {
      // In the order of the plain search, nothing behind it is worth more.
      if (weight_ == 0.0) open_.clear();
      continue;
    }
    expand(entry.node);
    if (unbounded_) return SearchStatus::Stopped;
    if (improved_ && weight_ > 0.0) return SearchStatus::Found;
  }
  return open_.empty() ? SearchStatus::Exhausted : SearchStatus::Running;
}

}  // namespace stepwright::pddl
