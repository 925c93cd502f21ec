#include "supervisor/pddl/search/engines/astar_search.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/space/gentle_growth.h"

namespace stepwright::pddl {
namespace {

// The dear bounds in their order; the number of steps is asked for when the cost can no longer tell.
constexpr std::uint8_t kCut = 0, kProgram = 1, kSteps = 2, kAll = 3;
// Of the linear program in every state: more rounds take more time than they save states.
constexpr int kRounds = 1;
constexpr std::uint64_t kSuccessorsBetweenChecks = 500;

}  // namespace

AStarSearch::AStarSearch(const StateSpace& space, SearchControl& control, const LowerBounds& bounds,
                         const DearBounds& dear)
    : space_(space),
      control_(control),
      bounds_(bounds),
      dear_(dear),
      best_(control),
      memory_(control),
      nodes_(space),
      scratch_(space.words()),
      current_(space.words()),
      least_potential_(evaluate_interval(space.task().potential, space.task().bounds).low) {
  if (dear.cut != nullptr) least_costs_.assign(dear.cut->costs().begin(), dear.cut->costs().end());
  if (dear.lp != nullptr) least_costs_.assign(dear.lp->costs().begin(), dear.lp->costs().end());
  const GroundTask& task = space.task();
  negative_ = std::any_of(task.operators.begin(), task.operators.end(),
                          [](const GroundOperator& op) { return !(op.cost.low >= 0.0); });
  // With cheap bounds a state costs less than its stubborn set.
  if (!negative_ && dear.any()) stubborn_ = std::make_unique<StubbornSets>(space);
  if (!negative_) dominance_ = std::make_unique<Dominance>(space);
  if (dominance_ && !dominance_->useful()) dominance_.reset();
  unit_cost_ = task.potential.is_constant() &&
               std::all_of(task.operators.begin(), task.operators.end(),
                           [](const GroundOperator& op) { return op.cost == Interval::point(1.0); });
}

void AStarSearch::push(const Entry& entry) {
  if (!best_().leaves_room_for(entry.key, entry.tie)) return;
  push_gently(open_, entry);
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

// `known`: the cost is at least this.
void AStarSearch::push(std::uint32_t node, const Word* state, double known) {
  const LowerBound rest = bounds_(state);
  if (rest.cost == kInfinity) return;
  const Node& n = nodes_[node];
  const double own = negative_ ? -kInfinity : comparable(n.cost + rest.cost + least_potential_);
  const double cost = std::max(own, known);
  double steps = static_cast<double>(n.steps + rest.steps);
  if (unit_cost_) steps = std::max(steps, std::ceil(cost - least_potential_ - 1e-6));
  push({cost, steps, node, n.steps, n.cost, dear_.any() ? kCut : kAll});
}

void AStarSearch::ask_for_steps(Entry& entry) {
  const Quality& best = best_();
  if (unit_cost_ || !best.found() || entry.key < best.cost) return;
  const double room = best.cost - entry.cost - least_potential_;
  const double rest = dear_.steps->steps(current_.data(), room, {.rounds = kRounds});
  if (rest == kInfinity) {
    entry.key = kInfinity;
  } else {
    entry.tie = std::max(entry.tie, static_cast<double>(entry.steps) + rest);
  }
}

// Asks the next bound about the state in `current_`.
void AStarSearch::ask(Entry& entry) {
  double rest = 0.0;
  switch (entry.asked++) {
    case kCut:
      if (dear_.cut == nullptr) break;
      rest = (*dear_.cut)(current_.data());
      asked_node_ = entry.node;
      break;
    case kProgram: {
      if (dear_.lp == nullptr) break;
      const double enough = best_().cost - entry.cost - least_potential_ + 1e-6;
      rest = dear_.lp->cost(current_.data(), {.rounds = kRounds, .enough = enough});
      asked_node_ = entry.node;
      break;
    }
    case kSteps:
    default:
      if (dear_.steps != nullptr) ask_for_steps(entry);
      return;
  }
  entry.key = std::max(entry.key, comparable(entry.cost + rest + least_potential_));
  if (unit_cost_) entry.tie = std::max(entry.tie, std::ceil(entry.cost + rest - 1e-6));
}

// Asks the dear bounds until one is higher. False if the entry has to wait for its new turn, or for ever.
bool AStarSearch::refine(Entry& entry) {
  if (entry.asked == kAll) return true;
  nodes_.load(entry.node, current_.data());
  const Entry before = entry;
  while (entry.asked != kAll) {
    ask(entry);
    if (entry.key == kInfinity) return false;
    if (entry.key == before.key && entry.tie == before.tie) continue;
    // If it is its turn all the same, what the bounds know of it need not be asked for again.
    if (best_().leaves_room_for(entry.key, entry.tie) && (open_.empty() || !(entry > open_.front())))
      continue;
    push(entry);
    return false;
  }
  return true;
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
  push(node, scratch_.data(),
       std::max(parent_key_, dear_.any() ? key_through(parent, op, cost) : -kInfinity));
}

// The cost of every plan along the best way to the parent that goes on with the operator, which costs more
// there than it costs at least.
double AStarSearch::key_through(std::uint32_t parent, int op, double cost) const {
  const double through = dear_.lp != nullptr ? dear_.lp->cost_through(op) : dear_.cut->cost_through(op);
  return comparable(nodes_[parent].cost + through + (cost - least_costs_[static_cast<std::size_t>(op)]) +
                    least_potential_);
}

void AStarSearch::ask_again(std::uint32_t node) {
  if (!dear_.any() || asked_node_ == node) return;
  asked_node_ = node;
  if (dear_.lp != nullptr) {
    dear_.lp->cost(current_.data(), {.rounds = kRounds});
  } else {
    (*dear_.cut)(current_.data());
  }
}

void AStarSearch::expand(const Entry& entry) {
  const std::uint32_t node = entry.node;
  parent_key_ = entry.key;
  control_.count_expanded(1);
  nodes_[node].closed = true;
  nodes_.load(node, current_.data());
  ask_again(node);
  space_.applicable(current_.data(), applicable_);
  if (stubborn_) stubborn_->prune(current_.data(), applicable_);
  successors_ += applicable_.size();
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
  push(root, current_.data(), -kInfinity);
}

double AStarSearch::bound() {
  if (!started_) return -kInfinity;
  const double best = best_().cost;
  return open_.empty() ? best : std::min(best, open_.front().key);
}

bool AStarSearch::needless(std::uint32_t node) {
  if (!dominance_) return false;
  nodes_.load(node, current_.data());
  return dominance_->prunes(node, current_.data(), nodes_);
}

std::size_t AStarSearch::memory() const {
  return nodes_.memory() + open_.capacity() * sizeof(Entry) + (dominance_ ? dominance_->memory() : 0) +
         (stubborn_ ? stubborn_->memory() : 0);
}

SearchStatus AStarSearch::run(std::uint64_t expansions, StopReason& reason) {
  if (!started_) start();
  const std::uint64_t pause = dear_.any() ? 4 : 64;
  std::uint64_t states = pause;  // since the control was asked
  successors_ = 0;
  for (std::uint64_t done = 0; done < expansions && !open_.empty(); ++done) {
    if (states++ >= pause || successors_ >= kSuccessorsBetweenChecks) {
      states = 1;
      successors_ = 0;
      control_.raise_bound(bound());
      memory_.set(memory());
      if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
    }
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    Entry entry = open_.back();
    open_.pop_back();
    const Node& node = nodes_[entry.node];
    if (node.steps != entry.steps || node.cost != entry.cost) continue;
    if (!best_().leaves_room_for(entry.key, entry.tie)) {
      // Nothing behind it is worth more.
      open_.clear();
      break;
    }
    if (needless(entry.node) || !refine(entry)) continue;
    expand(entry);
    if (unbounded_) return SearchStatus::Stopped;
  }
  if (!open_.empty()) return SearchStatus::Running;
  control_.raise_bound(best_().cost);
  return SearchStatus::Exhausted;
}

}  // namespace stepwright::pddl
