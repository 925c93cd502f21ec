#include "supervisor/pddl/search/improvement.h"

#include <algorithm>

namespace stepwright::pddl {

// Each weighted search ends with a better plan; the next one starts anew with a smaller weight and the better
// bound.
SearchStatus Improvement::improve(std::uint64_t expansions, StopReason& reason) {
  if (!weighted_) weighted_ = std::make_unique<AStarSearch>(space_, control_, bounds_, weight_);
  control_.other_memory = proof_.memory();
  const SearchStatus status = weighted_->run(expansions, reason);
  if (status == SearchStatus::Found) {
    weighted_.reset();
    weight_ = std::max(1.0, weight_ * 0.6);
  }
  return status;
}

bool Improvement::run(bool anytime, StopReason& reason) {
  // The first turn alone proves small tasks.
  std::uint64_t turn = anytime ? 20000 : UINT64_MAX;
  for (;; turn *= 2) {
    control_.other_memory = weighted_ ? weighted_->memory() : 0;
    SearchStatus status = proof_.run(turn, reason);
    if (status == SearchStatus::Exhausted) return true;
    if (status == SearchStatus::Stopped) return false;
    // A weighted search is slower per state by the heuristic.
    status = improve(turn / 4, reason);
    if (status == SearchStatus::Exhausted) return true;
    if (status == SearchStatus::Stopped) return false;
  }
}

}  // namespace stepwright::pddl
