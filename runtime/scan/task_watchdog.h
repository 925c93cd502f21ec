#pragma once

// The watchdog of one task, in the meaning of CODESYS (its "Time" and "Sensitivity" n): an exception when n
// executions in a row have taken longer than the time, or at once when one has taken longer than n times the
// time. A sensitivity of 0 means 1. What is measured is the execution, not how late it began.
//
// Thread rule: the task's thread. No heap, lock or clock inside.
//
//   scan::TaskWatchdog watchdog({.time_ns = 10'000'000, .sensitivity = 3});
//   watchdog.reset();                                 // at a start
//   if (watchdog.executed(took_ns)) ...               // after every execution: the outputs go safe

#include <cstdint>
#include <limits>

#include "runtime/bytecode/interrupt.h"

namespace stepwright::scan {

struct WatchdogLimits {
  std::int64_t time_ns = 0;       // 0: no watchdog
  std::uint32_t sensitivity = 1;  // n

  friend bool operator==(const WatchdogLimits&, const WatchdogLimits&) = default;
};

class TaskWatchdog {
 public:
  static constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

  TaskWatchdog() = default;
  explicit TaskWatchdog(const WatchdogLimits& limits) : limits_(limits) {}

  bool on() const { return limits_.time_ns > 0; }
  const WatchdogLimits& limits() const { return limits_; }
  // Executions in a row that were too long, the newest included.
  std::uint32_t too_long() const { return too_long_; }

  // Longest time of one execution; kNoLimit without a watchdog.
  std::int64_t longest_ns() const;

  // True if this execution is the one too many.
  bool executed(std::int64_t took_ns);
  void reset() { too_long_ = 0; }

 private:
  std::uint32_t sensitivity() const { return limits_.sensitivity == 0 ? 1 : limits_.sensitivity; }

  WatchdogLimits limits_;
  std::uint32_t too_long_ = 0;
};

// Told before and after every execution of a task, so that somebody outside the thread can see one that does
// not come back.
class TaskWatch {
 public:
  virtual ~TaskWatch() = default;

  // An execution begins that may last until `until_ns` of the scan's clock (kNoLimit: for ever). Scan thread;
  // no heap, lock or system call.
  virtual void begin(std::int64_t until_ns) = 0;
  virtual void end() = 0;
  // Through which that somebody ends an execution; null: not at all.
  virtual const bytecode::Interrupt* interrupt() const { return nullptr; }
};

}  // namespace stepwright::scan
