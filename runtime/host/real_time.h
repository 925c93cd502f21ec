#pragma once

// Services of the operating system for a scan thread: a monotonic clock, sleep until an instant, and, where
// it is permitted, a real-time priority and memory that is never paged out.
//
// Threads: any; a placement is that of the calling thread. A refusal of the system is reported and is no
// failure.

#include <cstdint>
#include <string>

#include "runtime/scan/clock.h"

namespace stepwright::host {

// CLOCK_MONOTONIC. Any thread.
class MonotonicClock final : public scan::Clock {
 public:
  std::int64_t now_ns() override;
};

// Sleeps until the monotonic clock shows `instant_ns`; at once if it has passed. Absolute, so that the time
// which the caller took before does not add up to a drift.
void sleep_until(std::int64_t instant_ns);

// How urgent a thread is among those of a runtime, and where it runs.
struct ThreadPlacement {
  int rank = 0;             // 0: the most urgent; each further rank gets a priority one lower
  bool background = false;  // no real-time priority at all: a freewheeling task must not starve the machine
  int cpu = -1;             // the only processor it runs on; -1: any of the process

  friend bool operator==(const ThreadPlacement&, const ThreadPlacement&) = default;
};

// Gives the calling thread its priority (SCHED_FIFO) and processor, whatever it had before. Returns what was
// refused, as a sentence for the status; empty if nothing was. No heap unless something was refused.
std::string place_thread(const ThreadPlacement& placement);

// Locks the memory of the process, present and future. Returns as place_thread does.
std::string lock_memory();

// Gives the calling thread a priority above the scan's, where that is permitted.
void enter_monitor_priority();

}  // namespace stepwright::host
