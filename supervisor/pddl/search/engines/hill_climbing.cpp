#include "supervisor/pddl/search/engines/hill_climbing.h"

#include <algorithm>

#include "supervisor/pddl/search/control/plan_runner.h"

namespace stepwright::pddl {

HillClimbing::HillClimbing(const RelaxedTask& task, SearchControl& control, const ClimbingOptions& options)
    : space_(task.space()),
      control_(control),
      best_plan_(control),
      memory_(control),
      options_(options),
      least_potential_(evaluate_interval(space_.task().potential, space_.task().bounds).low),
      nodes_(space_),
      state_(space_.initial()),
      child_(space_.words()),
      random_(options.seed) {
  if (options.costs) {
    additive_.emplace(task, cost_weights(space_.task()));
    marked_.assign(space_.task().operators.size(), 0);
  } else {
    intervals_.emplace(space_);
  }
}

bool HillClimbing::evaluate(const Word* state, int& estimate, std::vector<int>& to_try) {
  ++evaluations_;
  control_.count_expanded(1);
  if (additive_) {
    if (!additive_->evaluate(state)) return false;
    estimate = additive_->estimate();
    to_try = additive_->helpful();
    return true;
  }
  if (!intervals_->evaluate(state)) return false;
  estimate = intervals_->steps();
  to_try = intervals_->helpful();
  return true;
}

void HillClimbing::helpful_first(const Word* state, std::vector<int>& to_try) {
  ++expansions_;
  for (const int op : to_try) marked_[static_cast<std::size_t>(op)] = expansions_;
  space_.applicable(state, applicable_);
  for (const int op : applicable_) {
    if (marked_[static_cast<std::size_t>(op)] != expansions_) to_try.push_back(op);
  }
}

// Starts anew from the state, which a way of that cost leads to. False if nothing leads on.
bool HillClimbing::stand(const std::vector<Word>& state, double cost) {
  nodes_.clear();
  nodes_[nodes_.insert(state.data()).first].cost = cost;
  to_try_.assign(1, {});
  next_ = 0;
  return evaluate(state.data(), best_, to_try_[0]);
}

void HillClimbing::commit(std::uint32_t node) {
  const std::vector<int> path = nodes_.path(node);
  way_.insert(way_.end(), path.begin(), path.end());
}

// Can a plan along a way of that cost be better than the best?
bool HillClimbing::worth(double cost, std::uint32_t steps) {
  return best_plan_().leaves_room_for(comparable(cost + least_potential_), static_cast<double>(steps));
}

// True if a state was found that is nearer to the goal.
bool HillClimbing::expand(std::uint32_t node) {
  nodes_.load(node, state_.data());
  std::vector<int> operators = std::move(to_try_[node]);
  if (options_.seed != 0) std::shuffle(operators.begin(), operators.end(), random_);
  if (options_.all) helpful_first(state_.data(), operators);
  for (const int op : operators) {
    if (control_.check() != StopReason::None) return false;  // one state can take milliseconds
    double cost = nodes_[node].cost;
    const auto& precondition = space_.task().operators[static_cast<std::size_t>(op)].precondition;
    if (!space_.holds(precondition, state_.data())) continue;
    if (!space_.apply(op, state_.data(), child_.data(), cost)) continue;
    const std::uint32_t steps = nodes_[node].steps + 1;
    if (!worth(cost, static_cast<std::uint32_t>(way_.size()) + steps)) continue;
    const auto [child, added] = nodes_.insert(child_.data());
    if (!added) continue;
    nodes_[child] = {snap(cost), node, op, steps, false};
    to_try_.emplace_back();
    if (space_.goal(child_.data())) {
      commit(child);
      found_ = offer_plan(space_, control_, way_);
      arrived_ = ended_ = true;
      return true;
    }
    int estimate = 0;
    if (!evaluate(child_.data(), estimate, to_try_.back()) || estimate >= best_) continue;
    commit(child);
    ended_ = !stand(child_, nodes_[child].cost);
    return true;
  }
  return false;
}

SearchStatus HillClimbing::run(std::uint64_t evaluations, StopReason& reason) {
  const std::uint64_t last = evaluations_ + evaluations;
  if (!started_) ended_ = !stand(state_, 0.0);
  started_ = true;
  while (!ended_ && evaluations_ < last) {
    if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
    memory_.set(nodes_.memory());
    if (next_ >= nodes_.size()) {
      ended_ = true;
    } else {
      expand(next_++);
    }
  }
  if (found_) return SearchStatus::Found;
  return ended_ ? SearchStatus::Exhausted : SearchStatus::Running;
}

}  // namespace stepwright::pddl
