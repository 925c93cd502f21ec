#include "tests/support/pddl/true_distances.h"

#include <map>
#include <stdexcept>

namespace stepwright::pddl::testing {
namespace {

struct Edge {
  std::size_t from, to;
  double cost;
};

// Relaxes all edges until nothing changes: plain, and no queue to get wrong.
void settle(const std::vector<Edge>& edges, std::vector<StateDistance>& list) {
  for (bool changed = true; changed;) {
    changed = false;
    for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge) {
      StateDistance& from = list[edge->from];
      const StateDistance& to = list[edge->to];
      const double cost = edge->cost + to.cost;
      const bool cheaper = cost < from.cost - 1e-9;
      if (cheaper || (cost <= from.cost + 1e-9 && 1.0 + to.steps_of_cheapest < from.steps_of_cheapest)) {
        if (cheaper) from.cost = cost;
        from.steps_of_cheapest = 1.0 + to.steps_of_cheapest;
        changed = true;
      }
      if (1.0 + to.steps < from.steps) {
        from.steps = 1.0 + to.steps;
        changed = true;
      }
    }
  }
}

}  // namespace

std::vector<StateDistance> true_distances(const StateSpace& space, std::size_t most_states) {
  std::vector<StateDistance> list;
  std::map<std::vector<Word>, std::size_t> known;
  std::vector<Edge> edges;
  const auto number = [&](const std::vector<Word>& state) {
    const auto [place, added] = known.emplace(state, list.size());
    if (added) list.push_back({state, kInfinity, kInfinity});
    return place->second;
  };
  number(space.initial());
  std::vector<Word> next(space.words());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list.size() > most_states) throw std::runtime_error("the task is too large to enumerate");
    const std::vector<Word> state = list[i].state;
    if (space.goal(state.data())) list[i].cost = list[i].steps = list[i].steps_of_cheapest = 0.0;
    for (const GroundOperator& op : space.task().operators) {
      double cost = 0.0;
      if (!space.holds(op.precondition, state.data())) continue;
      if (space.apply(op, state.data(), next.data(), cost)) edges.push_back({i, number(next), cost});
    }
  }
  settle(edges, list);
  return list;
}

}  // namespace stepwright::pddl::testing
