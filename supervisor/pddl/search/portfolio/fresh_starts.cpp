#include "supervisor/pddl/search/portfolio/fresh_starts.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// States that the first searches may take, each.
constexpr std::uint64_t kThrifty = 300, kClimbing = 60'000, kWidth = 50'000;
// A climb that takes so many times as long as one that arrived has lost its way.
constexpr std::uint64_t kPatience = 4;

}  // namespace

FreshStarts::FreshStarts(const RelaxedTask& task, SearchControl& control, const Landmarks& landmarks)
    : task_(task), control_(control), longest_climb_(kClimbing) {
  LazyOptions thrifty;
  thrifty.weight = 1.5;
  thrifty.costs = true;
  thrifty.landmarks = landmarks.size() > 0 ? &landmarks : nullptr;
  add(std::make_shared<LazySearch>(task, control, thrifty), kThrifty);
  const ClimbingOptions helpful{.costs = true}, all{.costs = true, .all = true};
  add(std::make_shared<HillClimbing>(task, control, helpful), kClimbing);
  if (landmarks.size() > 0) add(std::make_shared<WidthSearch>(task, control, landmarks), kWidth);
  add(std::make_shared<HillClimbing>(task, control, all), kClimbing);
}

// Shared with nobody: std::function must be copyable.
template <typename Search>
void FreshStarts::add(std::shared_ptr<Search> search, std::uint64_t states) {
  starts_.push_back(
      {[search](std::uint64_t n, StopReason& reason) { return search->run(n, reason); }, states});
}

// Part of one climb. Returns the evaluations that it took.
std::uint64_t FreshStarts::climb(std::uint64_t evaluations, StopReason& reason, SearchStatus& status) {
  if (!climb_) {
    const ClimbingOptions options{.costs = true, .all = climbs_ % 4 == 3, .seed = climbs_ + 1};
    climb_ = std::make_unique<HillClimbing>(task_, control_, options);
    ++climbs_;
  }
  const std::uint64_t before = climb_->evaluations();
  status = climb_->run(evaluations, reason);
  const std::uint64_t after = climb_->evaluations();
  if (climb_->arrived()) longest_climb_ = std::min(longest_climb_, kPatience * after + 100);
  if (status != SearchStatus::Running || after > longest_climb_) climb_.reset();
  return after - before + 1;
}

// Part of one of the first searches. Returns the states that it took.
std::uint64_t FreshStarts::start(std::uint64_t states, StopReason& reason, SearchStatus& status) {
  Start& start = starts_[next_];
  const std::uint64_t taken = std::min(states, start.left);
  status = start.run(taken, reason);
  start.left = status == SearchStatus::Running ? start.left - taken : 0;
  if (start.left == 0) {
    start.run = nullptr;  // gives its memory back
    ++next_;
  }
  return taken;
}

// The first searches get two thirds until they have ended.
bool FreshStarts::run(std::uint64_t states, StopReason& reason) {
  while (states > 0) {
    SearchStatus status = SearchStatus::Running;
    const bool random = climbing_at_random() || ++turn_ % 3 == 0;
    const std::uint64_t turn = std::min<std::uint64_t>(states, 100);
    const std::uint64_t taken = random ? climb(turn, reason, status) : start(turn, reason, status);
    if (status == SearchStatus::Stopped) return false;
    states -= std::min(states, taken);
  }
  return true;
}

}  // namespace stepwright::pddl
