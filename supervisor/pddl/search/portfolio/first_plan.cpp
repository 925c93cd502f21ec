#include "supervisor/pddl/search/portfolio/first_plan.h"

#include <algorithm>
#include <thread>

namespace stepwright::pddl {
namespace {

// Where many steps of numbers lead to the goal, programs see the whole of them at once; a first look need not
// take them one by one.
constexpr std::size_t kQuickStates = 5'000;
// Finding what can change places takes about as long as the quick attempts.
constexpr SetLimits kSetLimits{.operators = 60'000, .facts = 10'000, .checks = 400'000};

}  // namespace

template <typename Search>
void FirstPlan::enter(Search& search, std::uint64_t share, bool first_thread, bool proves) {
  contenders_.push_back(
      {[&search](std::uint64_t expansions, StopReason& reason) { return search.run(expansions, reason); },
       share, first_thread, proves});
}

// Width goes where estimates mislead. Climbing crosses the plateaus of numbers without end; where numbers
// stand for what is short, like fuel, it helps to mind costs, and to do so from the start. Facts alone seldom
// need any of these. States with fewer estimates take less time: their searches have larger shares.
void FirstPlan::prepare() {
  const bool numbers = has_numbers();
  const Interchangeable* objects = objects_->none() ? nullptr : &*objects_;
  if (numbers) {
    enter(broad_.emplace(task_, control_, ClimbingOptions{.costs = true, .all = true}), 12, true, false);
    enter(cheap_.emplace(task_, control_, ClimbingOptions{.costs = true}), 4, false, false);
    enter(intervals_.emplace(task_, control_), 2, false, false);
  }
  if (landmarks_->size() > 0)
    enter(width_.emplace(task_, control_, *landmarks_, objects), numbers ? 2 : 8, true, true);
  LazyOptions options = with_landmarks();
  options.lookahead = false;
  options.intervals = numbers;
  options.objects = objects;
  enter(full_.emplace(task_, control_, options), 2, true, true);
  if (!numbers && threads_ < 2) return;
  LazyOptions thrifty = with_landmarks();
  thrifty.weight = 1.5;
  thrifty.costs = true;
  enter(thrifty_.emplace(task_, control_, thrifty), 4, false, true);
  if (!numbers) return;
  options.intervals = false;
  options.costs = true;
  enter(greedy_.emplace(task_, control_, options), 4, false, true);
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

// Short turns: each thread sees soon that the other is done.
SearchStatus FirstPlan::side_by_side(StopReason& reason) {
  constexpr std::uint64_t kShort = 16;
  std::atomic<bool> done{false};
  const auto second =
      std::stable_partition(contenders_.begin(), contenders_.end(),
                            [](const Contender& contender) { return contender.first_thread; });
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
  std::thread helper([&] { others = search({second, contenders_.end()}, others_reason); });
  const SearchStatus status = search({contenders_.begin(), second}, reason);
  helper.join();
  // What one has found or proved counts, also if the other was stopped meanwhile.
  const bool decided = status == SearchStatus::Found || status == SearchStatus::Exhausted;
  if (decided || others == SearchStatus::Running) return status;
  reason = others_reason;
  return others;
}

SearchStatus FirstPlan::run(StopReason& reason) {
  constexpr std::uint64_t kQuick = 150, kPrograms = 10, kWidth = 4000;
  LazyOptions quick;
  if (has_numbers()) quick.most_states = kQuickStates;
  SearchStatus status = LazySearch(task_, control_, quick).run(kQuick, reason);
  if (status != SearchStatus::Running) return status;
  landmarks_ = find_landmarks(task_, control_);
  if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
  if (landmarks_->size() > 0) {
    quick.landmarks = with_landmarks().landmarks;
    status = LazySearch(task_, control_, quick).run(kQuick, reason);
    if (status != SearchStatus::Running) return status;
  }
  if (has_numbers()) {
    status = CountingWalk(task_, control_).run(kPrograms, reason);
    if (status == SearchStatus::Found || status == SearchStatus::Stopped) return status;
  }
  objects_.emplace(task_.space(), kSetLimits);
  prepare();
  // Of facts alone width mostly makes short work: the other thread would only disturb.
  if (width_ && !has_numbers()) {
    status = width_->run(kWidth, reason);
    if (status != SearchStatus::Running) return status;
  }
  return threads_ < 2 ? take_turns(reason) : side_by_side(reason);
}

}  // namespace stepwright::pddl
