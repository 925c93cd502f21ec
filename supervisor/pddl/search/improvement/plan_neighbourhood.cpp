#include "supervisor/pddl/search/improvement/plan_neighbourhood.h"

#include <algorithm>
#include <functional>

#include "supervisor/pddl/search/control/plan_runner.h"

namespace stepwright::pddl {

PlanNeighbourhood::PlanNeighbourhood(const StateSpace& space, SearchControl& control,
                                     const LowerBounds& bounds)
    : space_(space),
      control_(control),
      bounds_(bounds),
      best_(control),
      memory_(control),
      nodes_(space),
      state_(space.words()),
      next_(space.words()),
      least_potential_(evaluate_interval(space.task().potential, space.task().bounds).low) {}

void PlanNeighbourhood::push(std::uint32_t node, std::uint32_t distance) {
  open_.push_back({distance, nodes_[node].cost, node});
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

bool PlanNeighbourhood::worth(std::uint32_t node, const Word* state) {
  const LowerBound rest = bounds_(state);
  if (rest.cost == kInfinity) return false;
  const Node& n = nodes_[node];
  return best_().leaves_room_for(comparable(n.cost + rest.cost + least_potential_),
                                 static_cast<double>(n.steps + rest.steps));
}

void PlanNeighbourhood::follow(const std::vector<int>& plan) {
  state_ = space_.initial();
  std::uint32_t node = nodes_.insert(state_.data()).first;
  push(node, 0);
  for (const int op : plan) {
    double cost = 0.0;
    if (!space_.apply(op, state_.data(), next_.data(), cost)) return;
    const auto [next, added] = nodes_.insert(next_.data());
    if (added) nodes_[next] = {snap(nodes_[node].cost + cost), node, op, nodes_[node].steps + 1, false};
    state_.swap(next_);
    node = next;
    push(node, 0);
  }
  // A plan that meets a state twice is shorter already.
  offer_goal(node, state_.data());
}

void PlanNeighbourhood::offer_goal(std::uint32_t node, const Word* state) {
  if (!space_.goal(state)) return;
  const double cost = nodes_[node].cost + space_.evaluate(space_.task().potential, state);
  if (!best_().leaves_room_for(comparable(cost), nodes_[node].steps)) return;
  offer_plan(space_, control_, nodes_.path(node));
}

void PlanNeighbourhood::successor(std::uint32_t parent, std::uint32_t distance, int op, double cost) {
  const double total = snap(nodes_[parent].cost + cost);
  const std::uint32_t steps = nodes_[parent].steps + 1;
  const auto [node, added] = nodes_.insert(next_.data());
  Node& n = nodes_[node];
  if (!added && (n.cost < total || (n.cost == total && n.steps <= steps))) return;
  const bool expanded = n.closed;
  n = {total, parent, op, steps, false};
  offer_goal(node, next_.data());
  // A better way to a state that was expanded already is handed on at once.
  if (worth(node, next_.data())) push(node, expanded ? 0 : distance + 1);
}

void PlanNeighbourhood::expand(std::uint32_t node, std::uint32_t distance) {
  control_.count_expanded(1);
  nodes_[node].closed = true;
  nodes_.load(node, state_.data());
  space_.applicable(state_.data(), applicable_);
  for (const int op : applicable_) {
    double cost = 0.0;
    if (space_.apply(op, state_.data(), next_.data(), cost)) successor(node, distance, op, cost);
  }
}

bool PlanNeighbourhood::search(const std::vector<int>& plan, std::uint64_t expansions, StopReason& reason) {
  follow(plan);
  for (std::uint64_t done = 0; done < expansions && !open_.empty(); ++done) {
    if (done % 32 == 0) {
      memory_.set(nodes_.memory() + open_.capacity() * sizeof(Entry));
      if ((reason = control_.check()) != StopReason::None) return false;
    }
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const Entry entry = open_.back();
    open_.pop_back();
    if (!nodes_[entry.node].closed) expand(entry.node, entry.distance);
  }
  return true;
}

}  // namespace stepwright::pddl
