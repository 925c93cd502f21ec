#pragma once

// Budget of refusals that the audit trail tells of one user, or of everybody who has not logged in: some at
// once, then few, so that nobody fills a disk by being refused. What is left out is counted.
//
//   if (const auto told = budget.take("ada")) write(entry, told->left_out);
//
// Threads: every function from any. Invariant: at most kMostUsers users are remembered; one more shares with
// nobody's.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "hmi_web/access/session_table.h"

namespace stepwright::access {

struct RefusalLimits {
  int at_once = 64;
  std::chrono::seconds next_after{60};  // one more, up to `at_once`
};

class RefusalBudget {
 public:
  static constexpr std::size_t kMostUsers = 256;

  RefusalBudget(const RefusalLimits& limits, Clock clock) : limits_(limits), clock_(std::move(clock)) {}

  struct Told {
    std::uint64_t left_out = 0;  // refusals before this one that were not told
  };
  // Nothing: this one is not told either. `user` is empty for whoever has not logged in.
  std::optional<Told> take(const std::string& user);

 private:
  struct Account {
    int spent = 0;
    std::uint64_t left_out = 0;
    std::chrono::steady_clock::time_point since;  // the next one comes back after this
  };

  const RefusalLimits limits_;
  const Clock clock_;
  std::mutex mutex_;
  std::map<std::string, Account> accounts_;  // guarded by mutex_
};

}  // namespace stepwright::access
