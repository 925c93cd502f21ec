#pragma once

// What a scan thread gets from the operating system: a monotonic clock, sleep until an instant, and, where it
// is permitted, a real-time priority and memory that is never paged out.

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

// Gives the calling thread SCHED_FIFO and locks the memory of the process. Returns what was refused, as a
// sentence for the status; empty if nothing was.
std::string enter_real_time();

// Gives the calling thread a priority above the scan's, where that is permitted.
void enter_monitor_priority();

}  // namespace stepwright::host
