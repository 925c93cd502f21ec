#pragma once

// Stop of a long computation: a time, and flags that somebody else sets. A value; the flags are not owned.
// Any thread.
//
//   if (stop.over()) return {};

#include <atomic>
#include <chrono>

namespace stepwright::ltl {

struct Stop {
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
  const std::atomic<bool>* cancel = nullptr;  // nobody wants it any more; may be null
  const std::atomic<bool>* enough = nullptr;  // another thread has what was looked for; may be null

  bool cancelled() const { return is_set(cancel); }
  bool unwanted() const { return is_set(cancel) || is_set(enough); }
  bool over() const { return unwanted() || std::chrono::steady_clock::now() >= until; }

 private:
  static bool is_set(const std::atomic<bool>* flag) {
    return flag != nullptr && flag->load(std::memory_order_relaxed);
  }
};

}  // namespace stepwright::ltl
