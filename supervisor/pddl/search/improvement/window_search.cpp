#include "supervisor/pddl/search/improvement/window_search.h"

#include <algorithm>
#include <functional>

namespace stepwright::pddl {

WindowSearch::WindowSearch(const RelaxedTask& task, SearchControl& control)
    : task_(task),
      space_(task.space()),
      control_(control),
      weights_(cost_weights(space_.task())),
      heuristic_(task, weights_),
      nodes_(space_),
      state_(space_.words()),
      next_(space_.words()),
      helpful_(space_.task().operators.size(), 0) {}

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

void WindowSearch::push(std::uint32_t node, double estimate, bool evaluated) {
  const Node& n = nodes_[node];
  open_.push_back({n.cost * weights_.scale + n.steps + estimate, order_++, node, n.cost, evaluated});
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

// Of the state in `state_`. False if nothing leads on.
bool WindowSearch::evaluate(std::uint32_t node) {
  if (!heuristic_.evaluate(state_.data())) return false;
  if (estimates_.size() <= node) estimates_.resize(nodes_.size());
  estimates_[node] = {heuristic_.estimate(), heuristic_.helpful()};
  return true;
}

// What the relaxed plan begins with is expected to do what it costs, everything else nothing.
void WindowSearch::expand(std::uint32_t node, const Quality& limit) {
  control_.count_expanded(1);
  nodes_[node].closed = true;
  const Estimate estimate = std::move(estimates_[node]);
  ++expansion_;
  for (const int op : estimate.helpful) helpful_[static_cast<std::size_t>(op)] = expansion_;
  space_.applicable(state_.data(), applicable_);
  for (const int op : applicable_) {
    double step = 0.0;
    if (!space_.apply(op, state_.data(), next_.data(), step)) continue;
    const double cost = snap(nodes_[node].cost + step);
    const std::uint32_t steps = nodes_[node].steps + 1;
    if (!limit.leaves_room_for(comparable(cost), steps)) continue;
    ++generated_;
    const auto [child, added] = nodes_.insert(next_.data());
    Node& n = nodes_[child];
    if (!added && (n.cost < cost || (n.cost == cost && n.steps <= steps))) continue;
    n = {cost, node, op, steps, false};
    const bool helpful = helpful_[static_cast<std::size_t>(op)] == expansion_;
    push(child, helpful ? std::max(0, estimate.value - weights_.weight(step)) : estimate.value, false);
  }
}

std::optional<std::vector<int>> WindowSearch::improve(const Window& window, std::int64_t& evaluations,
                                                      std::int64_t least) {
  constexpr std::int64_t kGeneratedPerEvaluation = 32;
  aim(window);
  open_.clear();
  estimates_.clear();
  order_ = 0;
  nodes_.clear();
  MemoryShare memory(control_);
  push(nodes_.insert(window.from).first, 0.0, false);
  const Quality limit{comparable(window.cost), window.steps};
  while (!open_.empty() && evaluations > least) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const Entry entry = open_.back();
    open_.pop_back();
    const Node& n = nodes_[entry.node];
    if (n.closed || n.cost != entry.cost) continue;
    memory.set(nodes_.memory());
    if (control_.check() != StopReason::None) return std::nullopt;
    nodes_.load(entry.node, state_.data());
    if (arrived(state_.data())) return nodes_.path(entry.node);
    if (!entry.evaluated) {
      --evaluations;
      if (!evaluate(entry.node)) continue;
      const int value = estimates_[entry.node].value;
      const double key = n.cost * weights_.scale + n.steps + value;
      if (!open_.empty() && key > open_.front().key) {
        push(entry.node, value, true);
        continue;
      }
    }
    expand(entry.node, limit);
    evaluations -= generated_ / kGeneratedPerEvaluation;
    generated_ %= kGeneratedPerEvaluation;
  }
  return std::nullopt;
}

}  // namespace stepwright::pddl
