#pragma once

// So many messages of one kind in a second; the others are counted and told of once.
//
//   RateLimit limit(10);
//   for (const Suppressed& each : limit.due(now)) say(each);     // of seconds that are over
//   if (limit.admit("trap", now)) say("trap ...");
//
// Threads: one at a time. Kinds are few and known to the program: they are never forgotten, and those beyond
// kMaxKinds share one budget.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stepwright::log {

struct Suppressed {
  std::string kind;
  std::uint64_t count = 0;
};

class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMaxKinds = 64;
  static constexpr std::chrono::seconds kWindow{1};

  explicit RateLimit(std::uint32_t per_window) : per_window_(per_window) {}

  void set_limit(std::uint32_t per_window) { per_window_ = per_window; }
  // True if a message of this kind may be written now; else it is counted.
  bool admit(std::string_view kind, Clock::time_point now);
  // Suppressed lines of windows that have ended, each once.
  std::vector<Suppressed> due(Clock::time_point now);
  // Suppressed lines that were not reported yet, at the end.
  std::vector<Suppressed> rest();

 private:
  struct Budget {
    Clock::time_point since{};
    std::uint32_t used = 0;
    std::uint64_t suppressed = 0;
  };

  std::uint32_t per_window_;
  std::map<std::string, Budget, std::less<>> budgets_;
};

}  // namespace stepwright::log
