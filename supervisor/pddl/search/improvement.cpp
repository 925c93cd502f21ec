#include "supervisor/pddl/search/improvement.h"

#include <algorithm>
#include <array>

#include "supervisor/pddl/search/action_elimination.h"
#include "supervisor/pddl/search/plan_neighbourhood.h"
#include "supervisor/pddl/search/plan_runner.h"

namespace stepwright::pddl {
namespace {

constexpr std::array kWeights = {0.0, 5.0, 3.0, 2.0, 1.0};
// States of the searches that start elsewhere, each.
constexpr std::uint64_t kThrifty = 300, kClimbing = 60'000, kWidth = 10'000;

}  // namespace

Improvement::Improvement(const RelaxedTask& task, SearchControl& control, const LowerBounds& bounds,
                         const Landmarks& landmarks)
    : task_(task), control_(control), bounds_(bounds), landmarks_(landmarks), windows_(task, control) {
  LazyOptions thrifty;
  thrifty.weight = 1.5;
  thrifty.costs = true;
  thrifty.landmarks = landmarks.size() > 0 ? &landmarks : nullptr;
  add_start(std::make_shared<LazySearch>(task, control, thrifty), 4, kThrifty);
  for (const bool all : {false, true}) {
    const ClimbingOptions climbing{.costs = true, .all = all};
    add_start(std::make_shared<HillClimbing>(task, control, climbing), all ? 4 : 8, kClimbing);
  }
  if (landmarks.size() > 0) add_start(std::make_shared<WidthSearch>(task, control, landmarks), 3, kWidth);
}

// Shared with nobody: std::function must be copyable.
template <typename Search>
void Improvement::add_start(std::shared_ptr<Search> search, std::uint64_t share, std::uint64_t states) {
  starts_.push_back(
      {[search](std::uint64_t n, StopReason& reason) { return search->run(n, reason); }, share, states});
}

// The first plan was the one that was quickest to find: searches that mind costs from the start, or look
// elsewhere, may end where its parts do not lead.
SearchStatus Improvement::start_elsewhere(std::uint64_t states, StopReason& reason) {
  std::uint64_t shares = 0;
  for (const Start& start : starts_) shares += start.share;
  for (Start& start : starts_) {
    const std::uint64_t turn = std::min(states * start.share / shares + 1, start.left);
    const SearchStatus status = start.run(turn, reason);
    if (status == SearchStatus::Stopped) return status;
    start.left = status == SearchStatus::Running ? start.left - turn : 0;
  }
  std::erase_if(starts_, [](const Start& start) { return start.left == 0; });
  return SearchStatus::Running;
}

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

// Searching and replanning windows get about the same share.
SearchStatus Improvement::run(std::uint64_t expansions, StopReason& reason) {
  const bool starting = !starts_.empty();
  SearchStatus status = start_elsewhere(expansions, reason);
  if (status == SearchStatus::Running) status = polish(expansions, reason);
  if (status == SearchStatus::Running && !starting) status = search(expansions, reason);
  if (status != SearchStatus::Running) return status;
  // Windows of a plan that will be another one soon are not worth as much.
  const auto evaluations = static_cast<std::int64_t>(starting ? expansions / 2 : expansions);
  return windows_.run(evaluations, reason) ? status : SearchStatus::Stopped;
}

}  // namespace stepwright::pddl
