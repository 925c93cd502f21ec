#pragma once

// Options of one task beside its program: when it starts within its interval, what happens when it could not
// start in time, and how long it may take. Plain data; any thread.

#include <cstdint>

#include "runtime/scan/task_watchdog.h"

namespace stepwright::scan {

// Policy for a cyclic task that is due again before its last cycle began (real time only: simulated time is
// never late).
enum class OverrunPolicy : std::uint8_t {
  Skip,     // the newest missed cycle runs, the others are left out; the task keeps its phase
  CatchUp,  // every missed cycle runs, one after the other, up to kMaxBacklog of them
  Fault,    // the program ends with its outputs in their safe state
};

// Cycles that CatchUp may be behind; what is beyond is left out, so that a task cannot lag for ever.
inline constexpr std::int64_t kMaxBacklog = 16;

struct TaskOptions {
  std::int64_t phase_ns = 0;  // first cycle this long after the start; 0 <= phase < interval
  OverrunPolicy overrun = OverrunPolicy::Skip;
  WatchdogLimits watchdog;
};

}  // namespace stepwright::scan
