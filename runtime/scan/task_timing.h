#pragma once

// Timing of a task, in fixed memory: distributions of its start latency, its execution time and its periods,
// and what was missed. The names follow CODESYS: jitter of a period is its distance from the interval.
//
// Thread rule: one writer, the thread that runs the task; readers copy it between two cycles.
//
//   timing.cycle({.due_ns = 1000, .begin_ns = 1010, .end_ns = 1200, .interval_ns = 500});

#include <cstdint>

#include "runtime/scan/histogram.h"

namespace stepwright::scan {

// One cycle, on the clock that measures. Without an instant at which it was due (an event, simulated time)
// there is no latency; without an interval there is no jitter.
struct TaskCycle {
  static constexpr std::int64_t kNone = -1;
  std::int64_t due_ns = kNone;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  std::int64_t interval_ns = kNone;
};

struct TaskTiming {
  Histogram latency;    // from due to begin
  Histogram execution;  // from begin to end
  Histogram jitter;     // |begin - begin before - interval|
  std::uint64_t cycles = 0;
  std::uint64_t overruns = 0;           // cycles that were due while an earlier one had not begun
  std::uint64_t skipped = 0;            // of these, the ones that were left out
  std::uint32_t too_long = 0;           // executions in a row that the watchdog counted, the newest included
  std::uint32_t watchdog_expiries = 0;  // of the task's own watchdog
  std::int64_t last_begin_ns = TaskCycle::kNone;

  void cycle(const TaskCycle& at);
  // The next period does not count: the task stood still or was restarted.
  void interrupted() { last_begin_ns = TaskCycle::kNone; }
};

}  // namespace stepwright::scan
