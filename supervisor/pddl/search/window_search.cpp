#include "supervisor/pddl/search/window_search.h"

#include <algorithm>
#include <functional>

namespace stepwright::pddl {

WindowSearch::WindowSearch(const RelaxedTask& task, SearchControl& control)
    : task_(task),
      space_(task.space()),
      control_(control),
      heuristic_(task, cost_weights(space_.task())),
      scale_(cost_weights(space_.task()).scale),
      nodes_(space_),
      state_(space_.words()),
      next_(space_.words()) {}

void WindowSearch::aim(const Window& window) {
  literals_ = window.needs->literals();
  comparisons_ = window.needs->comparisons(window.to);
  std::vector<int> atoms;
  for (const int literal : literals_) {
    if (const int atom = task_.atom_of_literal(literal); atom >= 0) atoms.push_back(atom);
  }
  heuristic_.aim(std::move(atoms), comparisons_);
}

bool WindowSearch::arrived(const Word* state) const {
  return std::all_of(literals_.begin(), literals_.end(), [&](int l) { return space_.literal(state, l); }) &&
         std::all_of(comparisons_.begin(), comparisons_.end(),
                     [&](const Comparison& comparison) { return space_.holds(comparison, state); });
}

void WindowSearch::push(std::uint32_t node, const Word* state) {
  if (!heuristic_.evaluate(state)) return;
  const Node& n = nodes_[node];
  open_.push_back({n.cost * scale_ + n.steps + heuristic_.estimate(), order_++, node});
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

std::optional<std::vector<int>> WindowSearch::improve(const Window& window, std::int64_t& evaluations,
                                                      std::int64_t least) {
  aim(window);
  open_.clear();
  order_ = 0;
  nodes_.clear();
  MemoryShare memory(control_);
  push(nodes_.insert(window.from).first, window.from);
  const Quality limit{comparable(window.cost), window.steps};
  while (!open_.empty() && evaluations > least) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const std::uint32_t node = open_.back().node;
    open_.pop_back();
    if (nodes_[node].closed) continue;
    nodes_[node].closed = true;
    memory.set(nodes_.memory());
    if (control_.check() != StopReason::None) return std::nullopt;
    nodes_.load(node, state_.data());
    if (arrived(state_.data())) return nodes_.path(node);
    control_.count_expanded(1);
    space_.applicable(state_.data(), applicable_);
    for (const int op : applicable_) {
      double cost = nodes_[node].cost;
      if (!space_.apply(op, state_.data(), next_.data(), cost)) continue;
      cost = snap(cost);
      const std::uint32_t steps = nodes_[node].steps + 1;
      if (!limit.leaves_room_for(comparable(cost), steps)) continue;
      const auto [child, added] = nodes_.insert(next_.data());
      Node& n = nodes_[child];
      if (!added && (n.cost < cost || (n.cost == cost && n.steps <= steps))) continue;
      n = {cost, node, op, steps, false};
      push(child, next_.data());
      --evaluations;
    }
  }
  return std::nullopt;
}

}  // namespace stepwright::pddl
