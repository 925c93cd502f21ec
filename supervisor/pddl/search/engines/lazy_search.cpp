#include "supervisor/pddl/search/engines/lazy_search.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/space/gentle_growth.h"

namespace stepwright::pddl {
namespace {

// Turns that the queues of preferred operators gain when an estimate reaches a new least value.
constexpr std::int64_t kBoost = 1000;

// A circle that earns something can be gone round for ever.
bool costs_can_fall(const GroundTask& task) {
  return std::any_of(task.operators.begin(), task.operators.end(),
                     [](const GroundOperator& op) { return !(op.cost.low >= 0.0); });
}

}  // namespace

LazySearch::LazySearch(const RelaxedTask& task, SearchControl& control, const LazyOptions& options)
    : task_(task),
      space_(task.space()),
      control_(control),
      options_(options),
      best_(control),
      memory_(control),
      weights_(options.costs ? cost_weights(space_.task()) : unit_weights(space_.task())),
      least_potential_(evaluate_interval(space_.task().potential, space_.task().bounds).low),
      additive_(task, weights_),
      lookahead_(task, control),
      costs_can_fall_(costs_can_fall(space_.task())),
      nodes_(space_),
      reached_(options.landmarks == nullptr ? 0 : (options.landmarks->size() + 63) / 64),
      state_(space_.words()),
      ahead_(space_.words()),
      scratch_(space_.words()),
      preferred_(space_.task().operators.size(), 0) {
  if (options.objects != nullptr) exchanges_.emplace(space_, *options.objects);
  if (options.intervals) intervals_.emplace(space_);
  if (options.landmarks != nullptr) count_.emplace(task, *options.landmarks, weights_.of);
  estimates_.resize(1 + (intervals_ ? 1 : 0) + (count_ ? 1 : 0));
  queues_.resize(2 * estimates_.size());
  for (std::size_t q = 1; q < queues_.size(); q += 2) queues_[q].preferred = true;
}

std::size_t LazySearch::bytes() const {
  std::size_t total = nodes_.memory() + reached_.memory();
  if (exchanges_) total += exchanges_->memory();
  for (const Queue& queue : queues_) total += queue.heap.capacity() * sizeof(Entry);
  return total;
}

// The queue that had the fewest turns.
bool LazySearch::pop(Entry& entry) {
  Queue* next = nullptr;
  for (Queue& queue : queues_) {
    if (!queue.heap.empty() && (next == nullptr || queue.turns < next->turns)) next = &queue;
  }
  if (next == nullptr) return false;
  ++next->turns;
  std::pop_heap(next->heap.begin(), next->heap.end(), std::greater<>());
  entry = next->heap.back();
  next->heap.pop_back();
  return true;
}

bool LazySearch::reached(std::uint32_t node, const Word* state) {
  if (!space_.goal(state)) return false;
  improved_ = offer_plan(space_, control_, nodes_.path(node)) || improved_;
  return true;
}

// Can a plan through the node be better than the best?
bool LazySearch::worth(std::uint32_t node, const Word* state) {
  const Quality& best = best_();
  if (!best.found() || options_.bounds == nullptr) return true;
  const LowerBound rest = (*options_.bounds)(state);
  if (rest.cost == kInfinity) return false;
  const Node& n = nodes_[node];
  return best.leaves_room_for(comparable(n.cost + rest.cost + least_potential_),
                              static_cast<double>(n.steps + rest.steps));
}

// Whether the way to `end` passes the node: it must not become its own ancestor.
bool LazySearch::leads_through(std::uint32_t node, std::uint32_t end) const {
  while (end != kNoNode && end != node) end = nodes_[end].parent;
  return end == node;
}

// The node after the entry's operator, its state in `state_`. kNoNode if it is known already by a way as
// good, or if the operator is undefined there.
std::uint32_t LazySearch::generate(const Entry& entry) {
  nodes_.load(entry.parent, scratch_.data());
  double cost = 0.0;
  if (!space_.apply(entry.op, scratch_.data(), state_.data(), cost)) return kNoNode;
  const auto [node, added] = nodes_.insert(state_.data());
  const Node& parent = nodes_[entry.parent];
  const double total = snap(parent.cost + cost);
  const std::uint32_t steps = parent.steps + 1;
  Node& n = nodes_[node];
  const bool better = added || total < n.cost || (total == n.cost && steps < n.steps);
  // A node that a lookahead passed is known and still waits for its turn.
  if (n.closed && (options_.weight == 0.0 || !better)) return kNoNode;
  if (better && !added && costs_can_fall_ && leads_through(node, entry.parent)) return kNoNode;
  if (better) n = {total, entry.parent, entry.op, steps, false};
  if (added && exchanges_ && !exchanges_->meet(state_.data())) {
    n.closed = true;
    return kNoNode;
  }
  if (count_) {
    const Word* before = reached_[entry.parent];
    Word* now = reached_[node];
    std::copy(before, before + count_->words(), now);
    count_->progress(state_.data(), now);
  }
  return node;
}

// All estimates of the node's state. False if one proves that no plan goes on from it.
bool LazySearch::evaluate(std::uint32_t node) {
  control_.count_expanded(1);
  ++expansion_;
  if (exchanges_) exchanges_->look_at(state_.data());
  if (!additive_.evaluate(state_.data(), exchanges_ ? exchanges_->needless_facts() : nullptr)) return false;
  std::size_t e = 0;
  estimates_[e++].value = additive_.estimate();
  if (intervals_) {
    if (!intervals_->evaluate(state_.data())) return false;
    estimates_[e++].value = intervals_->steps();
  }
  if (count_) estimates_[e++].value = count_->estimate(state_.data(), reached_[node]);
  bool progress = false;
  for (Estimate& estimate : estimates_) {
    if (estimate.value >= estimate.best) continue;
    estimate.best = estimate.value;
    progress = true;
  }
  for (Queue& queue : queues_) queue.turns -= progress && queue.preferred ? kBoost : 0;
  return true;
}

void LazySearch::mark_preferred(std::uint32_t node) {
  for (const int op : additive_.helpful()) preferred_[static_cast<std::size_t>(op)] = expansion_;
  if (intervals_) {
    for (const int op : intervals_->helpful()) preferred_[static_cast<std::size_t>(op)] = expansion_;
  }
  if (!count_) return;
  for (const int op : applicable_) {
    if (count_->reaches_another(op, reached_[node])) preferred_[static_cast<std::size_t>(op)] = expansion_;
  }
}

double LazySearch::key(std::uint32_t node, int estimate) const {
  if (options_.weight == 0.0) return estimate;
  const Node& n = nodes_[node];
  return n.cost * weights_.scale + static_cast<double>(n.steps) + options_.weight * estimate;
}

void LazySearch::push_successors(std::uint32_t node) {
  space_.applicable(state_.data(), applicable_);
  if (exchanges_) exchanges_->leave_out(applicable_);
  mark_preferred(node);
  for (std::size_t e = 0; e < estimates_.size(); ++e) {
    const double k = key(node, estimates_[e].value);
    for (std::size_t q = 2 * e; q < 2 * e + 2; ++q) {
      Queue& queue = queues_[q];
      for (const int op : applicable_) {
        if (queue.preferred && preferred_[static_cast<std::size_t>(op)] != expansion_) continue;
        push_gently(queue.heap, {k, order_++, node, op});
        std::push_heap(queue.heap.begin(), queue.heap.end(), std::greater<>());
      }
    }
  }
}

// Moves to the end of what can be executed of the relaxed plan, if that is new.
bool LazySearch::look_ahead(std::uint32_t& node) {
  const std::size_t known = nodes_.size();
  ahead_ = state_;
  std::uint32_t last = node;
  lookahead_.follow(ahead_, additive_.plan(), [&](int op, double cost, const std::vector<Word>& state) {
    if (nodes_.size() >= options_.most_states) return false;
    const auto [next, added] = nodes_.insert(state.data());
    if (next == last) return false;
    if (added) nodes_[next] = {snap(nodes_[last].cost + cost), last, op, nodes_[last].steps + 1, false};
    last = next;
    return true;
  });
  if (last == node || last < known || nodes_[last].closed) return false;
  if (count_) {
    // The landmarks on the way: from the last node that was known before to the new ones.
    std::vector<std::uint32_t> way;
    for (std::uint32_t n = last; n != node && n >= known; n = nodes_[n].parent) way.push_back(n);
    for (auto n = way.rbegin(); n != way.rend(); ++n) {
      const Word* before = reached_[nodes_[*n].parent];
      Word* now = reached_[*n];
      std::copy(before, before + count_->words(), now);
      nodes_.load(*n, scratch_.data());
      count_->progress(scratch_.data(), now);
    }
  }
  node = last;
  state_ = ahead_;
  return true;
}

// Goes on from the end of the lookahead as long as that is nearer to the goal.
void LazySearch::expand(std::uint32_t node) {
  for (int last = INT32_MAX;;) {
    nodes_[node].closed = true;
    if (!evaluate(node)) return;
    push_successors(node);
    const int now = estimates_.front().value;
    if (!options_.lookahead || now >= last || control_.check() != StopReason::None) return;
    last = now;
    if (!look_ahead(node) || !worth(node, state_.data())) return;
    if (reached(node, state_.data()) && improved_) return;
  }
}

void LazySearch::start() {
  started_ = true;
  state_ = space_.initial();
  const std::uint32_t root = nodes_.insert(state_.data()).first;
  if (exchanges_) (void)exchanges_->meet(state_.data());
  if (count_) count_->progress(state_.data(), reached_[root]);
  if (!reached(root, state_.data()) || !improved_) expand(root);
}

SearchStatus LazySearch::run(std::uint64_t expansions, StopReason& reason) {
  improved_ = false;
  if (!started_) start();
  Entry entry{};
  const std::uint32_t last =
      expansion_ + static_cast<std::uint32_t>(std::min<std::uint64_t>(expansions, UINT32_MAX / 4));
  for (std::uint64_t turn = 0; !improved_ && expansion_ < last; ++turn) {
    // Of a large task one state can take milliseconds.
    if (turn % 16 == 0) memory_.set(bytes());
    if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
    if (!pop(entry)) return SearchStatus::Exhausted;
    const std::uint32_t node = generate(entry);
    if (node == kNoNode || !worth(node, state_.data())) continue;
    if (!reached(node, state_.data()) || !improved_) expand(node);
  }
  return improved_ ? SearchStatus::Found : SearchStatus::Running;
}

}  // namespace stepwright::pddl
