#include "supervisor/pddl/search/first_plan.h"

#include <algorithm>
#include <thread>

namespace stepwright::pddl {

void FirstPlan::enter(LazySearch& search, std::uint64_t share) {
  contenders_.push_back(
      {[&search](std::uint64_t expansions, StopReason& reason) { return search.run(expansions, reason); },
       share});
}

// Climbing crosses the plateaus of numbers without end; where numbers stand for what is short, like fuel, it
// helps to mind costs, and to do so from the start. Facts alone seldom need any of these.
void FirstPlan::prepare() {
  const bool numbers = !task_.space().task().variables.empty();
  LazyOptions options = with_landmarks();
  options.lookahead = false;
  options.intervals = numbers;
  enter(full_.emplace(task_, control_, options), 2);
  if (!numbers && threads_ < 2) return;
  LazyOptions thrifty = with_landmarks();
  thrifty.weight = 1.5;
  thrifty.costs = true;
  enter(thrifty_.emplace(task_, control_, thrifty), 1);
  // States with fewer estimates take less time. The end of climbing is no proof.
  if (!numbers) return;
  options.intervals = false;
  options.costs = true;
  enter(greedy_.emplace(task_, control_, options), 4);
  if (!climbing_) return;
  contenders_.push_back(
      {[this](std::uint64_t expansions, StopReason& reason) { return climbing_->run(expansions, reason); }, 8,
       false});
}

LazyOptions FirstPlan::with_landmarks() const {
  LazyOptions options;
  options.landmarks = landmarks_->size() > 0 ? &*landmarks_ : nullptr;
  return options;
}

// One turn for each that has not ended. Running: nothing is decided, or all have ended without a proof.
SearchStatus FirstPlan::turn(std::span<Contender> contenders, std::uint64_t expansions, StopReason& reason) {
  for (Contender& contender : contenders) {
    if (contender.ended) continue;
    const SearchStatus status = contender.run(contender.share * expansions, reason);
    contender.ended = status == SearchStatus::Exhausted;
    const bool undecided = status == SearchStatus::Running || (contender.ended && !contender.proves);
    if (!undecided) return status;
  }
  return SearchStatus::Running;
}

SearchStatus FirstPlan::take_turns(StopReason& reason) {
  for (std::uint64_t expansions = 250;; expansions *= 2) {
    const SearchStatus status = turn(contenders_, expansions, reason);
    if (status != SearchStatus::Running) return status;
  }
}

// The first contender has a thread, the others share one. Short turns: each sees soon that the other is done.
SearchStatus FirstPlan::side_by_side(StopReason& reason) {
  constexpr std::uint64_t kShort = 16;
  std::atomic<bool> done{false};
  const std::span<Contender> all(contenders_);
  const auto search = [&](std::span<Contender> contenders, StopReason& why) {
    SearchStatus status = SearchStatus::Running;
    const auto ended = [](const Contender& contender) { return contender.ended; };
    while (status == SearchStatus::Running && !done &&
           !std::all_of(contenders.begin(), contenders.end(), ended)) {
      status = turn(contenders, kShort, why);
    }
    if (status != SearchStatus::Running) done = true;
    return status;
  };
  SearchStatus others = SearchStatus::Running;
  StopReason others_reason = StopReason::None;
  std::thread helper([&] { others = search(all.subspan(1), others_reason); });
  const SearchStatus status = search(all.first(1), reason);
  helper.join();
  // What one has found or proved counts, also if the other was stopped meanwhile.
  const bool decided = status == SearchStatus::Found || status == SearchStatus::Exhausted;
  if (decided || others == SearchStatus::Running) return status;
  reason = others_reason;
  return others;
}

SearchStatus FirstPlan::run(StopReason& reason) {
  constexpr std::uint64_t kQuick = 300, kClimb = 2000;
  SearchStatus status = LazySearch(task_, control_, {}).run(kQuick, reason);
  if (status != SearchStatus::Running) return status;
  if (!task_.space().task().variables.empty()) {
    status = climbing_.emplace(task_.space(), control_).run(kClimb, reason);
    if (status == SearchStatus::Found || status == SearchStatus::Stopped) return status;
    if (status == SearchStatus::Exhausted) climbing_.reset();
  }
  landmarks_.emplace(task_, [this] { return control_.check() != StopReason::None; });
  if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
  if (landmarks_->size() > 0) {
    status = LazySearch(task_, control_, with_landmarks()).run(kQuick, reason);
    if (status != SearchStatus::Running) return status;
  }
  prepare();
  return threads_ < 2 ? take_turns(reason) : side_by_side(reason);
}

}  // namespace stepwright::pddl
