#pragma once

// The tasks of a program as a scan needs them: sorted by priority, with what is due when. Portable; memory of
// fixed size.
//
// Thread rule: one thread at a time.

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "runtime/bytecode/program.h"
#include "runtime/scan/task_options.h"

namespace stepwright::scan {

// A freewheeling task (neither interval nor trigger) begins again as soon as it has ended and others had a
// moment to run. On a simulated clock, where no computing takes time, that is every 10 ms.
inline constexpr std::int64_t kFreewheelNs = 10'000'000;
inline constexpr std::int64_t kFreewheelRestNs = 100'000;

inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

struct Task {
  std::uint32_t index = 0;       // in the container's table
  std::int64_t interval_ns = 0;  // 0: runs on its trigger only
  std::int64_t due_ns = 0;
  std::int64_t wanted_ns = 0;  // when the cycle that runs next, or the first one left out for it, was due
  std::uint32_t priority = 0;  // 0 is the highest
  std::uint32_t first_call = 0;
  std::uint32_t call_count = 0;
  std::uint32_t frames = 0;                    // absolute address
  std::uint32_t trigger = bytecode::kNoIndex;  // absolute address of the BOOL; kNoIndex: none
  std::uint8_t trigger_bit = bytecode::kNoBit;
  bool freewheeling = false;
  bool triggered = false;       // the trigger as it was last seen
  std::int64_t counted_ns = 0;  // overruns before this instant are counted
  TaskOptions options;
  TaskWatchdog watchdog;

  bool has_trigger() const { return trigger != bytecode::kNoIndex; }
  // The trigger in this image. Requires has_trigger().
  bool trigger_now(std::span<const std::byte> image) const;
  // Its next cycle is due at `time_ns`.
  void due_at(std::int64_t time_ns) { due_ns = wanted_ns = time_ns; }
  // Goes on as `other`, a task of another program, would: its phase and what it saw of its trigger. Not due
  // later than one interval behind `next_ns`.
  void take_over(const Task& other, std::int64_t next_ns);
  // From `time_ns` on; the trigger counts as not seen.
  void restart(std::int64_t time_ns);
};

// Cycles of a task that were due before `now_ns` and have not begun.
struct Overrun {
  std::uint64_t missed = 0;   // newly found
  std::uint64_t skipped = 0;  // of these, left out
  bool fault = false;         // OverrunPolicy::Fault, and there were some
};

// Applies the task's policy at `now_ns`: moves due_ns to the cycle that is to run next.
Overrun settle_overrun(Task& task, std::int64_t now_ns);

class TaskTable {
 public:
  // Those of `mask` (bit i = task i of the container's table). `options` by the container's index; those
  // beyond its end have the defaults.
  TaskTable(const bytecode::Program& program, std::span<const TaskOptions> options, std::uint32_t mask);

  std::span<Task> tasks() { return std::span(tasks_).first(count_); }
  std::span<const Task> tasks() const { return std::span(tasks_).first(count_); }
  // The earliest instant at which a task is due; kNever without one.
  std::int64_t next_time_ns() const;

 private:
  std::array<Task, bytecode::kMaxTasks> tasks_{};  // the highest priority first
  std::size_t count_ = 0;
};

}  // namespace stepwright::scan
