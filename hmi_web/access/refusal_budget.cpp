#include "hmi_web/access/refusal_budget.h"

#include <algorithm>
#include <utility>

namespace stepwright::access {

std::optional<RefusalBudget::Told> RefusalBudget::take(const std::string& user) {
  const auto now = clock_();
  const std::lock_guard lock(mutex_);
  const bool known = accounts_.contains(user) || accounts_.size() < kMostUsers;
  Account& account = accounts_[known ? user : std::string()];
  if (account.spent == 0) account.since = now;
  const auto back = (now - account.since) / limits_.next_after;
  if (back > 0) {
    account.spent = static_cast<int>(std::max<std::int64_t>(0, account.spent - back));
    account.since += back * limits_.next_after;
  }
  if (account.spent >= limits_.at_once) {
    ++account.left_out;
    return std::nullopt;
  }
  ++account.spent;
  return Told{std::exchange(account.left_out, 0)};
}

}  // namespace stepwright::access
