#pragma once

// Limits of a search. Copies share nothing; one thread at a time.

#include <atomic>
#include <chrono>

namespace stepwright::fleet::internal {

class Limits {
 public:
  using Clock = std::chrono::steady_clock;

  // Zero: no limit. `cancel` may be null and is not owned.
  Limits(std::chrono::milliseconds time, const std::atomic<bool>* cancel)
      : begin_(Clock::now()), time_(time), cancel_(cancel) {}

  bool cancelled() const { return cancel_ != nullptr && cancel_->load(std::memory_order_relaxed); }
  bool over() const { return cancelled() || (time_.count() > 0 && Clock::now() - begin_ >= time_); }
  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
  }
  // From 0 to 1; 0 without a limit.
  double used() const { return time_.count() > 0 ? elapsed_ms() / static_cast<double>(time_.count()) : 0.0; }

 private:
  Clock::time_point begin_;
  std::chrono::milliseconds time_;
  const std::atomic<bool>* cancel_;
};

}  // namespace stepwright::fleet::internal
