#pragma once

// A thread that only wakes up: sleeps until each multiple of an interval and notes how late it woke. What it
// sees is what the machine can do just now, so that the scan beside it is compared with that and not with a
// machine that nobody else uses.
//
// Threads: its own; `timing` after it was stopped.

#include <atomic>
#include <cstdint>
#include <thread>

#include "runtime/scan/task_timing.h"

namespace stepwright::scan_test {

class BareLoop {
 public:
  // Begins at once, with the real-time priority of a scan; `first_ns` on the monotonic clock. cpu -1: any.
  BareLoop(std::int64_t first_ns, std::int64_t interval_ns, int cpu);
  ~BareLoop();
  BareLoop(const BareLoop&) = delete;
  BareLoop& operator=(const BareLoop&) = delete;

  void stop();
  const scan::TaskTiming& timing() const { return timing_; }

 private:
  void run(std::int64_t due_ns, std::int64_t interval_ns, int cpu);

  scan::TaskTiming timing_;
  std::atomic<bool> quit_{false};
  std::thread thread_;
};

}  // namespace stepwright::scan_test
