#pragma once

// Watch over a process that gives signs of life: one that has fallen silent hangs.
//
//   LifeWatch watch(std::chrono::seconds(5));
//   watch.heard(now);                              // at every sign of life
//   if (watch.silent(now)) ...                     // asked often
//
// Who asks may have been held up itself, and has heard nothing for that reason: such a time does not count.
//
// Threads: one. Times are passed in.

#include <chrono>
#include <optional>

namespace stepwright::processes {

class LifeWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `longest`: from one sign of life to the next.
  explicit LifeWatch(std::chrono::milliseconds longest) : longest_(longest) {}

  // The first one begins the watch.
  void heard(Time now) { heard_ = now; }
  // Until something is heard again.
  void end() { heard_.reset(); }
  bool silent(Time now);
  std::chrono::milliseconds longest() const { return longest_; }

 private:
  std::chrono::milliseconds longest_;
  std::optional<Time> heard_;
  Time asked_{};
};

}  // namespace stepwright::processes
