#include "supervisor/pddl/search/hill_climbing.h"

#include "supervisor/pddl/search/plan_runner.h"

namespace stepwright::pddl {

HillClimbing::HillClimbing(const StateSpace& space, SearchControl& control)
    : space_(space),
      control_(control),
      memory_(control),
      heuristic_(space),
      nodes_(space),
      state_(space.initial()),
      child_(space.words()) {}

bool HillClimbing::evaluate(const Word* state, int& estimate, std::vector<int>& helpful) {
  ++evaluations_;
  control_.count_expanded(1);
  if (!heuristic_.evaluate(state)) return false;
  estimate = heuristic_.steps();
  helpful = heuristic_.helpful();
  return true;
}

// Starts anew from the state. False if nothing leads on.
bool HillClimbing::stand(const std::vector<Word>& state) {
  nodes_.clear();
  nodes_.insert(state.data());
  helpful_.assign(1, {});
  next_ = 0;
  return evaluate(state.data(), best_, helpful_[0]);
}

void HillClimbing::commit(std::uint32_t node) {
  const std::vector<int> path = nodes_.path(node);
  way_.insert(way_.end(), path.begin(), path.end());
}

// True if a state was found that is nearer to the goal.
bool HillClimbing::expand(std::uint32_t node) {
  nodes_.load(node, state_.data());
  const std::vector<int> operators = std::move(helpful_[node]);
  for (const int op : operators) {
    double cost = 0.0;
    const auto& precondition = space_.task().operators[static_cast<std::size_t>(op)].precondition;
    if (!space_.holds(precondition, state_.data())) continue;
    if (!space_.apply(op, state_.data(), child_.data(), cost)) continue;
    const auto [child, added] = nodes_.insert(child_.data());
    if (!added) continue;
    nodes_[child] = {0.0, node, op, 0, false};
    helpful_.emplace_back();
    if (space_.goal(child_.data())) {
      commit(child);
      found_ = offer_plan(space_, control_, way_);
      ended_ = true;
      return true;
    }
    int estimate = 0;
    if (!evaluate(child_.data(), estimate, helpful_.back()) || estimate >= best_) continue;
    commit(child);
    ended_ = !stand(child_);
    return true;
  }
  return false;
}

SearchStatus HillClimbing::run(std::uint64_t evaluations, StopReason& reason) {
  const std::uint64_t last = evaluations_ + evaluations;
  if (!started_) ended_ = !stand(state_);
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
