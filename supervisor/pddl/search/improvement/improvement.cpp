#include "supervisor/pddl/search/improvement/improvement.h"

#include <algorithm>
#include <array>

#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/improvement/action_elimination.h"
#include "supervisor/pddl/search/improvement/plan_neighbourhood.h"

namespace stepwright::pddl {
namespace {

constexpr std::array kWeights = {0.0, 5.0, 3.0, 2.0, 1.0};

}  // namespace

Improvement::Improvement(const RelaxedTask& task, SearchControl& control, const LowerBounds& bounds,
                         const Landmarks& landmarks)
    : task_(task), control_(control), bounds_(bounds), landmarks_(landmarks), windows_(task, control) {}

// Until neither elimination nor the neighbourhood finds more.
SearchStatus Improvement::polish(std::uint64_t expansions, StopReason& reason) {
  while (polished_ != control_.version()) {
    polished_ = control_.version();
    const Incumbent best = control_.best();
    std::vector<int> shorter = eliminate_actions(task_.space(), best.operators, control_);
    offer_plan(task_.space(), control_, shorter);
    PlanNeighbourhood neighbourhood(task_.space(), control_, bounds_);
    if (!neighbourhood.search(shorter, std::min(expansions, effort_), reason)) return SearchStatus::Stopped;
  }
  return SearchStatus::Running;
}

void Improvement::next_stage() {
  weighted_.reset();
  ++stage_;
  effort_ *= 4;
  polished_ = 0;  // again, with more effort
}

SearchStatus Improvement::search(std::uint64_t expansions, StopReason& reason) {
  if (!weighted_) {
    LazyOptions options;
    options.weight = kWeights[std::min(stage_, kWeights.size() - 1)];
    options.costs = true;
    options.lookahead = stage_ == 0;
    options.landmarks = landmarks_.size() > 0 ? &landmarks_ : nullptr;
    options.bounds = &bounds_;
    weighted_ = std::make_unique<LazySearch>(task_, control_, options);
  }
  const SearchStatus status = weighted_->run(expansions, reason);
  const bool last = stage_ + 1 >= kWeights.size();
  // A greedy search does not come back to states that it finds a better way to: its end is no proof.
  if (status == SearchStatus::Exhausted && stage_ > 0) return status;
  const bool full = weighted_->memory() > control_.memory_limit() / 3;
  if (full || status == SearchStatus::Exhausted || (status == SearchStatus::Found && !last)) next_stage();
  return status == SearchStatus::Stopped ? status : SearchStatus::Running;
}

// Windows get about two thirds: they seldom leave a plan as it is.
SearchStatus Improvement::run(std::uint64_t expansions, StopReason& reason) {
  SearchStatus status = polish(expansions, reason);
  if (status == SearchStatus::Running) status = search(expansions / 2 + 1, reason);
  if (status != SearchStatus::Running) return status;
  return windows_.run(static_cast<std::int64_t>(expansions), reason) ? status : SearchStatus::Stopped;
}

}  // namespace stepwright::pddl
