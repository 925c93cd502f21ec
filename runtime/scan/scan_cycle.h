#pragma once

// The scan: read inputs, force, run the tasks that are due, force, write outputs, account.
// A task with a trigger (SINGLE) runs in the first scan that finds it risen, when its turn by priority comes;
// an edge that rises and falls between two scans is not seen. Time is the scan's own: task k-th scan runs at
// start + (k-1) x interval, whatever a clock on the wall says; who calls run_scan decides whether to wait for
// that instant (real time) or not (simulated time).
//
// Thread rule: one thread. No heap, lock, exception or log inside; memory is sized before the first scan.
// Invariants: while the state is not Running no task runs and every scan leaves the outputs in their safe
// state (but see hold_outputs_on_trap); a fault is left by start() or take_over() only.
//
//   scan::ScanCycle cycle(program, engine, image, driver, clock, {});
//   cycle.start({});
//   while (...) { wait_until(cycle.next_time_ns()); const scan::ScanReport report = cycle.run_scan(); }

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/program.h"
#include "runtime/image/force_table.h"
#include "runtime/image/io_driver.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/clock.h"
#include "runtime/scan/histogram.h"
#include "runtime/scan/safe_state.h"

namespace stepwright::scan {

// The layout of the memory that a program runs on.
image::ImageLayout layout_of(const bytecode::Program& program);

struct ScanConfig {
  std::uint64_t budget = 100'000'000;  // per scan, in bytes of code (bytecode::Engine); beyond it: Trap
  std::span<const SafeOutput> safe_outputs = {};  // must outlive the cycle; empty: all outputs to zero
};

enum class ScanState : std::uint8_t { Stopped, Running, Trapped, IoLost };

// Where a program takes over: at zero, or where the one before it stopped, so that the time of the plant goes
// on and one trace hash covers both.
struct StartPoint {
  std::int64_t time_ns = 0;  // of the first scan
  std::uint64_t scan = 0;    // scans before it
  std::uint64_t trace_hash = 0;
};

struct ScanReport {
  ScanState state = ScanState::Stopped;
  std::uint64_t scan = 0;    // 1-based number of this scan
  std::int64_t time_ns = 0;  // at which it ran
  std::uint64_t image_hash = 0;
  bytecode::Trap trap;  // of this scan; the state is Trapped then
};

struct ScanStatistics {
  Histogram scan_time;     // the whole scan, I/O drivers included
  Histogram program_time;  // the tasks only
  std::uint64_t scans = 0;
  std::uint64_t traps = 0;
  std::uint64_t io_losses = 0;
};

class ScanCycle {
 public:
  // Everything passed in must outlive the cycle. Requires an image of layout_of(program).
  ScanCycle(const bytecode::Program& program, bytecode::Engine& engine, image::ProcessImage& image,
            image::IoDriver& io, Clock& clock, const ScanConfig& config);

  // Cold start: every variable to its initial value, every task due at once, no fault, no force.
  void start(const StartPoint& at);

  // No task runs any more. The outputs are in their safe state when it returns.
  void stop();

  // Goes on where `before` stands, between two of its scans: scan number, time, trace, statistics and the
  // phases of the tasks. Image and forces are the caller's business; `before` stays as it is, so that it can
  // take over in its turn. `counterparts[i]` is the task of `before` (its index in the table) that task i of
  // this program stands for, or kNoIndex: such a task is due with the next scan. Requires a running `before`
  // and an entry for every task.
  void take_over(const ScanCycle& before, std::span<const std::uint32_t> counterparts);

  // While set, a trap does not put the outputs into their safe state: the caller has another program that
  // drives them from the next scan on, and until then they stay as the scan before left them.
  void hold_outputs_on_trap(bool hold) { hold_outputs_on_trap_ = hold; }

  // One scan at next_time_ns(): runs every task that is due then.
  ScanReport run_scan();

  // When the next task is due.
  std::int64_t next_time_ns() const;

  // Leaves out what is due before `time_ns` (a real-time overrun); tasks keep their phase.
  void skip_to(std::int64_t time_ns);

  ScanState state() const { return state_; }
  std::uint64_t scan() const { return scan_; }
  bytecode::Trap last_trap() const { return last_trap_; }

  // hash_mix over every scan's number and image hash since the trace began.
  std::uint64_t trace_hash() const { return trace_hash_; }

  image::ForceTable& forces() { return forces_; }
  const ScanStatistics& statistics() const { return statistics_; }

 private:
  struct TaskState {
    std::uint32_t index = 0;  // in the table
    std::int64_t interval_ns = 0;
    std::int64_t due_ns = 0;
    std::uint32_t priority = 0;
    std::uint32_t first_call = 0;
    std::uint32_t call_count = 0;
    std::uint32_t frames = 0;                    // absolute address
    std::uint32_t trigger = bytecode::kNoIndex;  // absolute address of the BOOL; kNoIndex: none
    std::uint8_t trigger_bit = bytecode::kNoBit;
    bool triggered = false;  // the trigger as it was last seen
  };
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  std::span<TaskState> tasks() { return std::span(tasks_).first(task_count_); }
  std::span<const TaskState> tasks() const { return std::span(tasks_).first(task_count_); }
  void load_tasks();
  void run_tasks(std::int64_t time_ns);
  bool is_to_run(TaskState& task, std::int64_t time_ns) const;
  bool run_calls(const TaskState& task, std::int64_t time_ns, std::uint64_t& budget);
  void advance(std::int64_t time_ns);
  void write_outputs(std::int64_t time_ns);

  bytecode::Program program_;
  bytecode::Engine& engine_;
  image::ProcessImage& image_;
  image::IoDriver& io_;
  Clock& clock_;
  ScanConfig config_;
  image::ForceTable forces_;
  std::array<TaskState, bytecode::kMaxTasks> tasks_{};  // the highest priority first
  std::size_t task_count_ = 0;
  ScanState state_ = ScanState::Stopped;
  bytecode::Trap last_trap_;
  std::uint64_t scan_ = 0;
  std::int64_t last_time_ns_ = 0;
  std::uint64_t trace_hash_ = 0;
  ScanStatistics statistics_;
  bool hold_outputs_on_trap_ = false;
};

}  // namespace stepwright::scan
