#include "supervisor/pddl/search/greedy_search.h"

#include <algorithm>
#include <functional>

namespace stepwright::pddl {
namespace {

// Turns that the helpful queue gains when the estimate improves.
constexpr int kBoost = 1000;

}  // namespace

GreedySearch::GreedySearch(const StateSpace& space, SearchControl& control)
    : space_(space), control_(control), heuristic_(space), nodes_(space.words()), scratch_(space.words()) {}

std::size_t GreedySearch::memory() const {
  return nodes_.memory() + (all_.capacity() + helpful_.capacity()) * sizeof(Entry);
}

void GreedySearch::push(Queue& queue, int estimate, std::uint32_t parent, int op) {
  queue.push_back({estimate, order_++, parent, op});
  std::push_heap(queue.begin(), queue.end(), std::greater<>());
}

// Serves the queue that had fewer turns.
bool GreedySearch::pop(Entry& entry) {
  const bool use_helpful = !helpful_.empty() && (all_.empty() || helpful_turns_ <= all_turns_);
  Queue& queue = use_helpful ? helpful_ : all_;
  if (queue.empty()) return false;
  ++(use_helpful ? helpful_turns_ : all_turns_);
  std::pop_heap(queue.begin(), queue.end(), std::greater<>());
  entry = queue.back();
  queue.pop_back();
  return true;
}

bool GreedySearch::reached(std::uint32_t node) {
  if (!space_.goal(nodes_.state(node))) return false;
  const double cost = nodes_[node].cost + space_.evaluate(space_.task().potential, nodes_.state(node));
  control_.offer(nodes_.path(node), cost, nodes_[node].steps);
  return true;
}

// The state after the entry's operator, or kNoNode if it is known already or the operator is undefined there.
std::uint32_t GreedySearch::generate(const Entry& entry) {
  double cost = 0.0;
  const GroundOperator& op = space_.task().operators[static_cast<std::size_t>(entry.op)];
  if (!space_.apply(op, nodes_.state(entry.parent), scratch_.data(), cost)) return kNoNode;
  const auto [node, added] = nodes_.insert(scratch_.data());
  if (!added) return kNoNode;
  nodes_[node] = {snap(nodes_[entry.parent].cost + cost), entry.parent, entry.op,
                  nodes_[entry.parent].steps + 1, false};
  return node;
}

void GreedySearch::expand(std::uint32_t node) {
  ++control_.expanded;
  if (!heuristic_.evaluate(nodes_.state(node))) return;
  const int estimate = heuristic_.steps();
  if (estimate < best_estimate_) {
    best_estimate_ = estimate;
    helpful_turns_ -= kBoost;
  }
  space_.applicable(nodes_.state(node), applicable_);
  const std::vector<int>& helpful = heuristic_.helpful();
  for (const int op : applicable_) {
    push(all_, estimate, node, op);
    if (std::binary_search(helpful.begin(), helpful.end(), op)) push(helpful_, estimate, node, op);
  }
}

SearchStatus GreedySearch::run(StopReason& reason) {
  const std::vector<Word> initial = space_.initial();
  const auto [root, added] = nodes_.insert(initial.data());
  if (added) {
    if (reached(root)) return SearchStatus::Found;
    expand(root);
  }
  Entry entry{};
  for (std::uint64_t turn = 0; pop(entry); ++turn) {
    if (turn % 16 == 0 && (reason = control_.check(memory())) != StopReason::None)
      return SearchStatus::Stopped;
    const std::uint32_t node = generate(entry);
    if (node == kNoNode) continue;
    if (reached(node)) return SearchStatus::Found;
    expand(node);
  }
  return SearchStatus::Exhausted;
}

}  // namespace stepwright::pddl
