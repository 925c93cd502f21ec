#include "tests/bench/planner/baseline/hill_climbing.h"

#include <algorithm>
#include <deque>
#include <queue>
#include <tuple>

#include "supervisor/pddl/grounding/grounder.h"
#include "tests/bench/planner/baseline/relaxed_graph.h"
#include "tests/bench/planner/baseline/state_store.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using State = std::vector<pddl::Word>;

struct Node {
  std::uint32_t parent;
  int op;
};

class Search {
 public:
  Search(const pddl::GroundTask& ground, const BaselineLimits& limits, Clock::time_point start,
         Baseline& result)
      : ground_(ground), space_(ground), graph_(space_), limits_(limits), start_(start), result_(result) {}

  void run() {
    std::vector<int> plan;
    result_.climbed = climb(plan);
    if (!result_.climbed && !stopped()) {
      plan.clear();
      if (!best_first(plan)) return;
    } else if (!result_.climbed) {
      return;
    }
    result_.found = true;
    for (const int op : plan)
      result_.actions.push_back(pddl::action_of(ground_, ground_.operators[static_cast<std::size_t>(op)]));
  }

  bool stopped() {
    if (limits_.time.count() > 0 && Clock::now() - start_ > limits_.time)
      result_.reason = "the time budget ended";
    if (limits_.memory_mb > 0 && memory_ > limits_.memory_mb << 20)
      result_.reason = "the memory budget ended";
    return !result_.reason.empty();
  }

 private:
  bool successor(int op, const pddl::Word* from, State& to) {
    double cost = 0.0;
    return space_.apply(ground_.operators[static_cast<std::size_t>(op)], from, to.data(), cost);
  }

  std::optional<int> estimate(const pddl::Word* state) {
    ++result_.evaluated;
    return graph_.estimate(state);
  }

  // From better state to better state, breadth first in between.
  bool climb(std::vector<int>& plan) {
    State state = space_.initial();
    std::optional<int> best = estimate(state.data());
    while (best && !space_.goal(state.data())) {
      if (!step(state, *best, plan)) return false;
    }
    return best.has_value();
  }

  bool step(State& state, int& best, std::vector<int>& plan) {
    StateStore seen(space_.words());
    std::vector<Node> nodes = {{0, -1}};
    std::vector<std::vector<int>> helpful;
    seen.insert(state.data());
    estimate(state.data());
    helpful.push_back(graph_.helpful());
    State next(space_.words());
    for (std::uint32_t node = 0; node < seen.size(); ++node) {
      for (const int op : helpful[node]) {
        if (!space_.holds(ground_.operators[static_cast<std::size_t>(op)].precondition, seen[node])) continue;
        if (!successor(op, seen[node], next)) continue;
        if (!seen.insert(next.data()).second) continue;
        nodes.push_back({node, op});
        const std::optional<int> h = estimate(next.data());
        helpful.push_back(h ? graph_.helpful() : std::vector<int>{});
        memory_ = seen.memory();
        if (stopped()) return false;
        if (!h || (*h >= best && !space_.goal(next.data()))) continue;
        append_path(nodes, static_cast<std::uint32_t>(nodes.size() - 1), plan);
        state = next;
        best = *h;
        return true;
      }
    }
    return false;
  }

  static void append_path(const std::vector<Node>& nodes, std::uint32_t node, std::vector<int>& plan) {
    const auto start = static_cast<std::ptrdiff_t>(plan.size());
    for (; nodes[node].op >= 0; node = nodes[node].parent) plan.push_back(nodes[node].op);
    std::reverse(plan.begin() + start, plan.end());
  }

  // Eager: every successor is estimated when it is generated.
  bool best_first(std::vector<int>& plan) {
    StateStore states(space_.words());
    std::vector<Node> nodes = {{0, -1}};
    using Entry = std::tuple<int, std::uint64_t, std::uint32_t>;  // estimate, order, node
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const State initial = space_.initial();
    states.insert(initial.data());
    open.emplace(0, 0, 0);
    State next(space_.words());
    std::vector<int> applicable;
    while (!open.empty()) {
      const std::uint32_t node = std::get<2>(open.top());
      open.pop();
      space_.applicable(states[node], applicable);
      for (const int op : applicable) {
        if (!successor(op, states[node], next) || !states.insert(next.data()).second) continue;
        nodes.push_back({node, op});
        const auto added = static_cast<std::uint32_t>(nodes.size() - 1);
        if (space_.goal(next.data())) {
          append_path(nodes, added, plan);
          return true;
        }
        if (const std::optional<int> h = estimate(next.data())) open.emplace(*h, nodes.size(), added);
        memory_ = states.memory() + nodes.size() * (sizeof(Node) + sizeof(Entry));
        if (stopped()) return false;
      }
    }
    result_.reason = "the estimate sees a dead end everywhere";
    return false;
  }

  const pddl::GroundTask& ground_;
  pddl::StateSpace space_;
  RelaxedGraph graph_;
  const BaselineLimits& limits_;
  Clock::time_point start_;
  Baseline& result_;
  std::size_t memory_ = 0;
};

}  // namespace

Baseline hill_climbing(const pddl::Task& task, const BaselineLimits& limits) {
  const Clock::time_point start = Clock::now();
  Baseline result;
  const pddl::GroundTask ground = pddl::ground_task(
      task.definition(), [&] { return limits.time.count() > 0 && Clock::now() - start > limits.time; });
  if (ground.cancelled) {
    result.reason = "the time budget ended while grounding";
    return result;
  }
  if (ground.unreachable_goal) {
    result.reason = *ground.unreachable_goal;
    return result;
  }
  Search(ground, limits, start, result).run();
  return result;
}

}  // namespace stepwright::bench
