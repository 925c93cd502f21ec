#pragma once

// Watch over the supervisor: it is alive if it was heard of within a time, from whichever client speaks for
// it.
//
// Threads: one. The first sign of life begins the watch: a runtime that never had a supervisor has not lost
// one.

#include <chrono>

namespace stepwright::service::internal {

class SupervisorWatch {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Change { None, Came, Lost };

  explicit SupervisorWatch(std::chrono::milliseconds lost_after) : lost_after_(lost_after) {}

  void heard(Clock::time_point now) {
    heard_ = true;
    last_ = now;
  }
  void set_lost_after(std::chrono::milliseconds lost_after) { lost_after_ = lost_after; }
  // Whether it counts as lost unless something is heard of it.
  bool overdue(Clock::time_point now) const { return alive_ && now - last_ > lost_after_; }
  // The change since the last call.
  Change check(Clock::time_point now) {
    const bool alive = heard_ && now - last_ <= lost_after_;
    if (alive == alive_) return Change::None;
    alive_ = alive;
    return alive ? Change::Came : Change::Lost;
  }
  // The change just reported could not be passed on: report it again.
  void repeat() { alive_ = !alive_; }

 private:
  std::chrono::milliseconds lost_after_;
  Clock::time_point last_{};
  bool heard_ = false;
  bool alive_ = false;
};

}  // namespace stepwright::service::internal
