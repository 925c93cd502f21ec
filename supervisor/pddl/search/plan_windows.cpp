#include "supervisor/pddl/search/plan_windows.h"

#include <algorithm>

#include "supervisor/pddl/search/cluster_plan.h"
#include "supervisor/pddl/search/plan_runner.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kShortest = 8;
constexpr std::int64_t kLeastEffort = 300;

}  // namespace

// False if the plan cannot be executed.
bool PlanWindows::take(std::vector<int> plan) {
  plan_ = std::move(plan);
  states_.assign(1, space_.initial());
  costs_.assign(1, 0.0);
  std::vector<Word> next(space_.words());
  for (const int op : plan_) {
    double cost = costs_.back();
    if (!space_.apply(op, states_.back().data(), next.data(), cost)) return false;
    states_.push_back(next);
    costs_.push_back(snap(cost));
  }
  return true;
}

// Windows overlap by two thirds. After the last, longer ones follow; after the longest, more effort.
void PlanWindows::next_window() {
  if (first_ + length_ < plan_.size()) {
    first_ += std::max<std::size_t>(1, length_ / 3);
    return;
  }
  first_ = 0;
  length_ *= 2;
  if (length_ < 2 * plan_.size()) return;
  length_ = kShortest;
  effort_ *= 4;
}

PlanNeeds PlanWindows::needs_after(std::size_t step) const {
  PlanNeeds needs(space_, states_.back().data());
  for (std::size_t i = plan_.size(); i > step; --i) needs.prepend(plan_[i - 1], states_[i - 1].data());
  return needs;
}

void PlanWindows::improve(std::size_t last, std::int64_t& evaluations) {
  const PlanNeeds needs = needs_after(last);
  const std::int64_t least = evaluations - effort_;
  const auto better =
      search_.improve({states_[first_].data(), states_[last].data(), &needs, costs_[last] - costs_[first_],
                       static_cast<std::uint32_t>(last - first_)},
                      evaluations, least);
  if (!better) return;
  std::vector<int> whole(plan_.begin(), plan_.begin() + static_cast<std::ptrdiff_t>(first_));
  whole.insert(whole.end(), better->begin(), better->end());
  whole.insert(whole.end(), plan_.begin() + static_cast<std::ptrdiff_t>(last), plan_.end());
  if (!offer_plan(space_, control_, whole)) return;
  version_ = control_.version();
  take(std::move(whole));
}

bool PlanWindows::run(std::int64_t evaluations, StopReason& reason) {
  while (evaluations > 0) {
    if ((reason = control_.check()) != StopReason::None) return false;
    if (version_ != control_.version()) {
      version_ = control_.version();
      if (!take(cluster_plan(space_, control_.best().operators))) return true;
      first_ = 0;
      length_ = kShortest;
      effort_ = kLeastEffort;
    }
    if (plan_.size() < 2) return true;
    improve(std::min(plan_.size(), first_ + length_), evaluations);
    --evaluations;
    next_window();
  }
  return true;
}

}  // namespace stepwright::pddl
