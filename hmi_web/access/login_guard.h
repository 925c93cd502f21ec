#pragma once

// Slows down whoever guesses passwords: after a few failures each further one locks for twice as long. Keys
// are names and addresses; those that do not exist are treated like those that do, so that nothing is told.
//
//   if (const auto wait = guard.locked_for("user ada"); wait > 0s) ...   // refused, not even tried
//   guard.failed("user ada");
//
// Threads: every function from any. Invariant: at most kMostKeys keys are remembered.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "hmi_web/access/session_table.h"

namespace stepwright::access {

struct LoginLimits {
  int free_failures = 4;               // without any lock
  std::chrono::seconds first_lock{2};  // after the next one; doubles with each
  std::chrono::seconds longest_lock{300};
  std::chrono::seconds forgotten{15 * 60};  // without a failure: as if there had been none
};

class LoginGuard {
 public:
  static constexpr std::size_t kMostKeys = 1'024;

  LoginGuard(const LoginLimits& limits, Clock clock) : limits_(limits), clock_(std::move(clock)) {}

  // 0 = it may be tried.
  std::chrono::seconds locked_for(const std::string& key) const;
  void failed(const std::string& key);
  void succeeded(const std::string& key);

 private:
  struct Entry {
    int failures = 0;
    std::chrono::steady_clock::time_point last;
    std::chrono::steady_clock::time_point locked_until;
  };

  const LoginLimits limits_;
  const Clock clock_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;  // guarded by mutex_
};

// Pairs of name and address that have logged in since the start. The lock against guessing does not count for
// them. Threads: every function from any. At most kMostKeys pairs, the oldest go.
class KnownLogins {
 public:
  static constexpr std::size_t kMostKeys = 1'024;

  void remember(const std::string& name, const std::string& address);
  bool knows(const std::string& name, const std::string& address) const;

 private:
  mutable std::mutex mutex_;
  std::uint64_t last_ = 0;
  std::map<std::pair<std::string, std::string>, std::uint64_t>
      pairs_;  // guarded by mutex_; the order of log-ins
};

}  // namespace stepwright::access
