#pragma once

// Pulse of the scan: whether it is alive, judged from outside by its progress. The init system's watchdog is
// fed only while this says so.
//
//   ScanPulse pulse(500ms);
//   pulse.set_period(10ms);                    // of the program that is loaded now
//   pulse.see(status, now);                    // at least every 100 ms
//   if (pulse.alive(now)) init.watchdog();
//
// Threads: one. While nothing is to be scanned (no program, stopped, at a barrier) there is nothing to be
// late with.

#include <chrono>
#include <cstdint>

#include "runtime/host/messages.h"

namespace stepwright::cell_runtime {

class ScanPulse {
 public:
  using Clock = std::chrono::steady_clock;

  // A scan that is due and does not come for this long, or for kPeriods of its periods if that is longer,
  // hangs.
  explicit ScanPulse(Clock::duration patience) : patience_(patience) {}
  static constexpr int kPeriods = 4;

  // Of the tasks, on the clock on the wall.
  void set_period(std::chrono::nanoseconds period) { period_ = period; }
  void see(const host::RuntimeStatus& status, Clock::time_point now) {
    const bool due = status.state == host::RuntimeState::Running && !status.waiting_for_supervisor;
    if (!due || !due_ || status.scan != scan_ || status.incarnation != incarnation_) progress_ = now;
    due_ = due;
    scan_ = status.scan;
    incarnation_ = status.incarnation;
  }
  bool alive(Clock::time_point now) const {
    const Clock::duration slow = std::chrono::duration_cast<Clock::duration>(period_ * kPeriods);
    return !due_ || now - progress_ <= (slow > patience_ ? slow : patience_);
  }

 private:
  Clock::duration patience_;
  std::chrono::nanoseconds period_{0};
  bool due_ = false;
  std::uint64_t scan_ = 0;
  std::uint64_t incarnation_ = 0;
  Clock::time_point progress_{};
};

}  // namespace stepwright::cell_runtime
