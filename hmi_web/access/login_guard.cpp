#include "hmi_web/access/login_guard.h"

#include <algorithm>

namespace stepwright::access {

std::chrono::seconds LoginGuard::locked_for(const std::string& key) const {
  const auto now = clock_();
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(key);
  if (found == entries_.end() || found->second.locked_until <= now) return std::chrono::seconds(0);
  return std::chrono::ceil<std::chrono::seconds>(found->second.locked_until - now);
}

void LoginGuard::failed(const std::string& key) {
  const auto now = clock_();
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [&](const auto& entry) { return now - entry.second.last >= limits_.forgotten; });
  if (entries_.size() >= kMostKeys && !entries_.contains(key)) {
    entries_.erase(std::min_element(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) {
      return a.second.last < b.second.last;
    }));
  }
  Entry& entry = entries_[key];
  ++entry.failures;
  entry.last = now;
  if (entry.failures <= limits_.free_failures) return;
  const int doublings = std::min(entry.failures - limits_.free_failures - 1, 20);
  entry.locked_until = now + std::min(limits_.first_lock * (1 << doublings), limits_.longest_lock);
}

void LoginGuard::succeeded(const std::string& key) {
  const std::lock_guard lock(mutex_);
  entries_.erase(key);
}

void KnownLogins::remember(const std::string& name, const std::string& address) {
  const std::lock_guard lock(mutex_);
  pairs_[{name, address}] = ++last_;
  if (pairs_.size() <= kMostKeys) return;
  pairs_.erase(std::min_element(pairs_.begin(), pairs_.end(),
                                [](const auto& a, const auto& b) { return a.second < b.second; }));
}

bool KnownLogins::knows(const std::string& name, const std::string& address) const {
  const std::lock_guard lock(mutex_);
  return pairs_.contains({name, address});
}

}  // namespace stepwright::access
