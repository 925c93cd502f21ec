#pragma once

// Policy for starting a process again that has ended: at first soon, then later and later, and not any more
// when it has failed too often before it was ready.
//
//   RestartPolicy policy;
//   policy.ready(now);
//   if (const auto rest = policy.ended(now)) start at now + *rest; else leave it;
//
// Threads: one. Times are passed in.

#include <chrono>
#include <optional>

namespace stepwright::processes {

struct RestartSettings {
  std::chrono::milliseconds first{100};      // before the first new start
  std::chrono::milliseconds longest{5'000};  // it is doubled from one to the next, up to this
  std::chrono::milliseconds steady{10'000};  // who has been ready for so long begins with `first` again
  int most_failures = 5;                     // one after the other, before it was ready
};

class RestartPolicy {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit RestartPolicy(RestartSettings settings = {}) : settings_(settings), rest_(settings.first) {}

  // It has said that it is ready.
  void ready(Time now);
  // It has ended: how long to wait before it is started again; nothing: it is left alone.
  std::optional<std::chrono::milliseconds> ended(Time now);
  // How often it has ended without having been ready, since it was ready last.
  int failures() const { return failures_; }

 private:
  RestartSettings settings_;
  std::chrono::milliseconds rest_;
  std::optional<Time> ready_since_;
  int failures_ = 0;
};

}  // namespace stepwright::processes
