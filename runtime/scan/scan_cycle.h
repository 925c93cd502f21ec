#pragma once

// The scan: read inputs, force, run the tasks that are due, force, write outputs, account.
// A task with a trigger (SINGLE) runs in the first scan that finds it risen, when its turn by priority comes;
// an edge that rises and falls between two scans is not seen. Time is the scan's own: task k-th scan runs at
// start + (k-1) x interval, whatever a clock on the wall says; who calls run_scan decides whether to wait for
// that instant (real time) or not (simulated time).
//
// Thread rule: one thread at a time. A cycle may run some of the tasks only (ScanConfig::own_tasks); others
// that run on copies of the image then report what they did by begin_foreign and end_foreign, between two
// scans. No heap, lock, exception or log inside; memory is sized before the first scan.
// Invariants: while the state is not Running no task runs and every scan leaves the outputs in their safe
// state (but see hold_outputs_on_trap); a fault is left by start() or take_over() only.
//
//   std::vector<std::byte> safe_outputs(image.outputs().size());
//   scan::ScanCycle cycle(program, engine, image, safe_outputs, driver, clock, {});
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
#include "runtime/scan/task_execution.h"
#include "runtime/scan/task_table.h"
#include "runtime/scan/task_timing.h"

namespace stepwright::scan {

// The layout of the memory that a program runs on.
image::ImageLayout layout_of(const bytecode::Program& program);

// Options of a cycle. The data of the spans must outlive it.
struct ScanConfig {
  std::uint64_t budget = 100'000'000;  // per scan, in bytes of code (bytecode::Engine); beyond it: Trap; not
                                       // for tasks whose watchdog can end them
  SafeMatrix safe_state = {};          // without rules all outputs go to zero
  std::span<const TaskOptions> tasks = {};  // by the index of the container's table
  std::span<TaskTiming> timings = {};       // the same; empty: nothing is measured per task
  TaskWatch* watch = nullptr;               // told of every execution
  std::uint32_t own_tasks = 0xFFFF'FFFF;    // bit i: this cycle runs task i of the container's table
  // Real time: what the clock shows at scan time 0, so that the start of a task can be compared with the
  // instant at which it was due.
  std::int64_t clock_origin_ns = kNoOrigin;

  static constexpr std::int64_t kNoOrigin = std::numeric_limits<std::int64_t>::min();
};

enum class ScanState : std::uint8_t {
  Stopped,
  Running,
  Trapped,
  IoLost,
  WatchdogExpired,
  Overrun,  // a task was late, and its policy is OverrunPolicy::Fault
};

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
  bytecode::Trap trap;  // new in this scan; the state is Trapped or WatchdogExpired then
};

struct ScanStatistics {
  Histogram scan_time;     // the whole scan, I/O drivers included
  Histogram program_time;  // the tasks only
  std::uint64_t scans = 0;
  std::uint64_t traps = 0;
  std::uint64_t io_losses = 0;
  std::uint64_t watchdogs = 0;
  std::uint64_t overruns = 0;  // of all tasks
};

// Where a cycle stands between two scans: with the image and the forces, all that the next scan depends on.
struct CyclePoint {
  struct Task {
    std::uint32_t index = 0;  // in the container's table
    std::int64_t due_ns = 0;
    bool triggered = false;
  };
  ScanState state = ScanState::Stopped;
  std::uint64_t scan = 0;
  std::int64_t last_time_ns = 0;  // of the newest scan
  std::uint64_t trace_hash = 0;
  std::uint32_t task_count = 0;
  std::array<Task, bytecode::kMaxTasks> tasks{};  // the cycle's own, in the order of their priority
};

class ScanCycle {
 public:
  // Everything passed in must outlive the cycle. Requires an image of layout_of(program), and for the outputs
  // as somebody drove them last `safe_outputs`: as many bytes as the driver has outputs, at least as many as
  // the program has, outside the image. A safe state holds and ramps from those, not from values in the image
  // that a force or the scan of a fault has left and that were never written. Outputs behind the program's
  // are driven as well: they stay in their safe state while it runs.
  ScanCycle(const bytecode::Program& program, bytecode::Engine& engine, image::ProcessImage& image,
            std::span<std::byte> safe_outputs, image::IoDriver& io, Clock& clock, const ScanConfig& config);

  // Cold start: every variable to its initial value, every task due at once, no fault, no force.
  void start(const StartPoint& at);

  // No task runs any more. The outputs are in the safe state of the cause when it returns. A cause that came
  // before it stays. At `time_ns`, where ramps begin; without it at the instant of the newest scan.
  void stop(SafeCause cause, std::int64_t time_ns);
  void stop(SafeCause cause = SafeCause::Stop) { stop(cause, last_time_ns_); }

  // The outputs go on as somebody drove them before: the cycle of another program, or a process that is gone.
  // At `time_ns` the cause comes again, so that ramps begin where they were left. Requires that nothing runs.
  void inherit_outputs(std::span<const std::byte> driven, SafeCause cause, std::int64_t time_ns);

  // While no program runs: fresh inputs, safe outputs. Requires that.
  void idle(std::int64_t time_ns);

  // Goes on where `before` stands, between two of its scans: scan number, time, trace, statistics and the
  // phases of the tasks. Image and forces are the caller's business; `before` stays as it is, so that it can
  // take over in its turn. `counterparts[i]` is the task of `before` (its index in the table) that task i of
  // this program stands for, or kNoIndex: such a task is due with the next scan. Requires a running `before`
  // and an entry for every task.
  void take_over(const ScanCycle& before, std::span<const std::uint32_t> counterparts);

  // While set, a trap does not put the outputs into their safe state: the caller has another program that
  // drives them from the next scan on, and until then they stay as the scan before left them.
  // Ended while a trap holds them, that goes to the safe state of its cause.
  void hold_outputs_on_trap(bool hold);

  // One scan at next_time_ns(): runs every task that is due then.
  ScanReport run_scan();

  // When the next task is due.
  std::int64_t next_time_ns() const { return table_.next_time_ns(); }

  // Real time, before a scan that begins at scan time `time_ns`: what was missed is dealt with as each task's
  // policy says. A fault leaves the outputs in their safe state; run_scan reports it.
  void settle_overruns(std::int64_t time_ns);

  // Leaves out what is due before `time_ns`; tasks keep their phase.
  void skip_to(std::int64_t time_ns);

  // A task that is not this cycle's own begins at `time_ns`: inputs are read. False if it may not run.
  bool begin_foreign(std::int64_t time_ns);
  // It was executed and, unless it trapped, its values are in the image: outputs are written.
  void end_foreign(std::int64_t time_ns, const Execution& done);
  // It was late; `fault`: as OverrunPolicy::Fault wants it.
  void foreign_overrun(const Overrun& overrun, std::int64_t time_ns);

  // The report of a fault between two scans (of a foreign task), which no scan has to bring any more.
  // Requires that the state is not Running.
  ScanReport report_fault();

  // Where it stands, and how it goes on from there: of the same program, with an image as it was then. Forces
  // stay as they are.
  CyclePoint point() const;
  void resume(const CyclePoint& point);

  ScanState state() const { return state_; }
  std::uint64_t scan() const { return scan_; }
  bytecode::Trap last_trap() const { return last_trap_; }
  // The outputs while the state is not Running.
  const SafeState& safe_state() const { return safe_; }
  const WatchdogReport& watchdog_report() const { return watchdog_report_; }

  // hash_mix over every scan's number and image hash since the trace began.
  std::uint64_t trace_hash() const { return trace_hash_; }

  image::ForceTable& forces() { return forces_; }
  const ScanStatistics& statistics() const { return statistics_; }

 private:
  bool real() const { return config_.clock_origin_ns != ScanConfig::kNoOrigin; }
  void fail(ScanState state, SafeCause cause, std::int64_t time_ns);
  void fail(const Execution& done, std::int64_t time_ns);
  void make_safe(std::int64_t time_ns);
  bool holds_outputs() const;
  ScanReport report(std::int64_t time_ns);
  std::span<const std::byte> rest() const { return safe_.outputs().subspan(image_.outputs().size()); }
  void move_rest(std::int64_t time_ns);
  std::int64_t io_time(std::int64_t time_ns);
  void read_inputs(std::int64_t time_ns);
  void run_tasks(std::int64_t time_ns);
  bool is_to_run(Task& task, std::int64_t time_ns) const;
  void account(const Task& task, bool due, const Execution& done);
  void advance(std::int64_t time_ns);
  void write_outputs(std::int64_t time_ns);

  bytecode::Program program_;
  bytecode::Engine& engine_;
  image::ProcessImage& image_;
  image::IoDriver& io_;
  Clock& clock_;
  ScanConfig config_;
  image::ForceTable forces_;
  TaskTable table_;
  ScanState state_ = ScanState::Stopped;
  bool fault_reported_ = true;
  bytecode::Trap last_trap_;
  std::uint64_t scan_ = 0;
  std::int64_t last_time_ns_ = 0;
  std::int64_t io_time_ns_ = 0;  // what the driver was told last; never goes back
  std::uint64_t trace_hash_ = 0;
  ScanStatistics statistics_;
  SafeState safe_;
  WatchdogReport watchdog_report_;
  bool hold_outputs_on_trap_ = false;
  SafeCause held_cause_ = SafeCause::Trap;  // of the trap whose outputs are held
};

}  // namespace stepwright::scan
