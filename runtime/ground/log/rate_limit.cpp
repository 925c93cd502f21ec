#include "runtime/ground/log/rate_limit.h"

#include <utility>

namespace stepwright::log {

bool RateLimit::admit(std::string_view kind, Clock::time_point now) {
  auto found = budgets_.find(kind);
  if (found == budgets_.end()) {
    const bool room = budgets_.size() < kMaxKinds;
    found = budgets_.try_emplace(room ? std::string(kind) : std::string("other"), Budget{now, 0, 0}).first;
  }
  Budget& budget = found->second;
  if (now - budget.since >= kWindow) {
    budget.since = now;
    budget.used = 0;
  }
  if (budget.used < per_window_) {
    ++budget.used;
    return true;
  }
  ++budget.suppressed;
  return false;
}

std::vector<Suppressed> RateLimit::due(Clock::time_point now) {
  std::vector<Suppressed> ended;
  for (auto& [kind, budget] : budgets_) {
    if (budget.suppressed > 0 && now - budget.since >= kWindow) {
      ended.push_back({kind, std::exchange(budget.suppressed, 0)});
    }
  }
  return ended;
}

std::vector<Suppressed> RateLimit::rest() {
  std::vector<Suppressed> left;
  for (auto& [kind, budget] : budgets_) {
    if (budget.suppressed > 0) left.push_back({kind, std::exchange(budget.suppressed, 0)});
  }
  return left;
}

}  // namespace stepwright::log
