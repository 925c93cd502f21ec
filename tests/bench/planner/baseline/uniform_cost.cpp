#include "tests/bench/planner/baseline/uniform_cost.h"

#include <queue>
#include <tuple>
#include <vector>

#include "supervisor/pddl/grounding/grounder.h"
#include "tests/bench/planner/baseline/state_store.h"

namespace stepwright::bench {
namespace {

struct Node {
  double cost = 0.0;
  std::uint32_t steps = 0;
  bool closed = false;
};

}  // namespace

UniformCost uniform_cost(const pddl::Task& task) {
  const pddl::GroundTask ground = pddl::ground_task(task.definition(), [] { return false; });
  const pddl::StateSpace space(ground);
  StateStore states(space.words());
  std::vector<Node> nodes(1);
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // cost, steps, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const std::vector<pddl::Word> initial = space.initial();
  states.insert(initial.data());
  open.emplace(0.0, 0, 0);
  std::vector<pddl::Word> next(space.words());
  std::vector<int> applicable;
  UniformCost result;
  while (!open.empty()) {
    const auto [cost, steps, node] = open.top();
    open.pop();
    if (nodes[node].closed) continue;
    nodes[node].closed = true;
    ++result.expanded;
    if (space.goal(states[node])) {
      result.found = true;
      result.cost = cost + ground.base_cost;
      result.steps = steps;
      return result;
    }
    space.applicable(states[node], applicable);
    for (const int op : applicable) {
      double total = cost;
      const auto& applied = ground.operators[static_cast<std::size_t>(op)];
      if (!space.apply(applied, states[node], next.data(), total)) continue;
      const auto [successor, added] = states.insert(next.data());
      if (added) nodes.emplace_back();
      Node& n = nodes[successor];
      if (!added && std::tie(n.cost, n.steps) <= std::make_tuple(total, steps + 1)) continue;
      n.cost = total;
      n.steps = steps + 1;
      open.emplace(total, steps + 1, successor);
    }
  }
  return result;
}

}  // namespace stepwright::bench
