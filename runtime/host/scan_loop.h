#pragma once

// The scan thread: takes commands between two scans, waits for the next one (or, in simulated time, does
// not), runs it, compares the steps, and publishes events, figures and the image. In real time neither the
// service nor the link nor a supervisor can delay a scan. In real time commands, a fault of another task and
// the end interrupt the wait for a scan that is far away; a stop and the news of a supervisor's life go ahead
// of every other command.
//
// Threads: `run` is the body of the scan thread; the functions under "service thread" belong to that one
// thread; `quit` may be called from any. No heap, lock or log on the path of a scan; a Notifier is set (one
// system call) only when there is news for the service. Invariants: in any state but Running the outputs are
// in their safe state; in simulated time the clock moves only while the state is Running and no barrier
// holds.

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/host/area_driver.h"
#include "runtime/host/change_trial.h"
#include "runtime/host/clock_gate.h"
#include "runtime/host/command.h"
#include "runtime/host/event_count.h"
#include "runtime/host/fault_schedule.h"
#include "runtime/host/host_config.h"
#include "runtime/host/notifier.h"
#include "runtime/host/plant_access.h"
#include "runtime/host/prepared_program.h"
#include "runtime/host/real_time.h"
#include "runtime/host/scan_monitor.h"
#include "runtime/host/seq_cell.h"
#include "runtime/host/snapshot_memory.h"
#include "runtime/host/spsc_queue.h"
#include "runtime/host/wake_signal.h"
#include "runtime/record/scan_tap.h"
#include "runtime/scan/histogram.h"

namespace stepwright::host {

// Figures of the scan thread, published for the service thread.
struct ScanFigures {
  RuntimeState state = RuntimeState::Empty;
  bool waiting_for_supervisor = false;
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;
  EventCount events;
  std::uint64_t overruns = 0;
  std::uint64_t trace_hash = 0;
  std::int64_t scan_p50_ns = 0;
  std::int64_t scan_p99_ns = 0;
  std::int64_t scan_max_ns = 0;
  double realtime_factor = 0.0;
  // The programs that the scan thread uses: the one that is loaded; the one before it while a change is on
  // trial, or that a rollback put away until its event is out. Null: none.
  const PreparedProgram* program = nullptr;
  const PreparedProgram* kept = nullptr;
  std::uint64_t changes = 0;
  std::int64_t last_change_pause_ns = 0;
};

// The forces and their program, published whenever either changes.
struct ForceList {
  FixedText<kDigestLetters> program_digest;
  std::array<image::Force, image::ForceTable::kCapacity> forces;
  std::size_t count = 0;
};

// Real clock: so close to a scan nothing disturbs the wait for it.
inline constexpr std::int64_t kUndisturbedNs = 2'000'000;

class ScanLoop {
 public:
  // References must outlive the loop; `plant` may be null.
  ScanLoop(const HostConfig& config, AreaDriver& io, PlantAccess* plant, SnapshotWriter& snapshots,
           record::RetainManager& retain);

  // Until `quit`; then the outputs are in their safe state.
  void run();
  void quit();

  // Service thread.
  bool submit(Command command);
  std::optional<Completion> take_completion() { return completions_.pop(); }
  ScanFigures figures() const { return figures_.load(); }
  ForceList forces() const { return forces_.load(); }
  // Notifies of completions and events.
  Notifier& news() { return news_; }
  // The event ring of the program that runs was full and has room again.
  void events_taken() { wake_.notify(); }

  // A task on a thread of its own has ended the program with a fault: it is reported now. Any thread.
  void task_failed() {
    task_failed_.store(true, std::memory_order_release);
    wake_.notify();
  }

  // Measures scans and, in real time, sets them off; forces end by it. Any thread.
  scan::Clock& clock() { return clock_; }
  // The clock's time at scan time 0.
  std::int64_t clock_origin_ns() const { return origin_ns_; }
  // Of the scan thread. Any thread.
  ThreadLiveness& liveness() { return liveness_; }
  bool ok() const { return news_.ok(); }

 private:
  // Commands (scan_loop_commands.cpp).
  void take_commands();
  Completion held_apply(const Command& command);
  bool meant_for_another(const Command& command) const;
  Completion other_program(const Command& command) const;
  Completion apply(const Command& command);
  Outcome load(PreparedProgram* program);
  Outcome start(const Command& command);
  bool time_for_commands(std::int64_t begin_ns);
  result::Diagnostics refused_start(const Command& command) const;
  Outcome stop(std::string_view reason, scan::SafeCause cause = scan::SafeCause::Stop);
  Outcome force(const ImageBits& bits, std::int64_t duration_ns);
  Outcome unforce(const ImageBits& bits);
  Outcome write(const ImageBits& bits);
  Outcome write_block(const BlockWrite& block);
  Completion inject_fault(const Command& command);
  void supervisor_lost();
  Completion step(const Command& command);
  void record(record::Session* session);
  record::Running running();
  void end_forces();
  void publish_forces();
  void adopt(PreparedProgram& program);
  void take_place_of(const TaskPlan& tasks);

  // Online change (scan_loop_change.cpp).
  std::optional<Command> next_command(std::int64_t begin_ns);
  Completion change(const Command& command);
  bool tried(const scan::ScanReport& report);
  void roll_back(const bytecode::Trap& trap);
  void retain_from(PreparedProgram& next);
  void end_trial();

  // One turn of the loop (scan_loop.cpp).
  void turn_real();
  bool reached(std::int64_t due_ns);
  void report_task_failure();
  void turn_simulated();
  void scan_once();
  void faulted(const scan::ScanReport& report);
  void idle_io(std::int64_t time_ns);
  void emit(EventKind kind, const bytecode::Trap& trap, std::string_view reason,
            const PreparedProgram* other = nullptr);
  void note(EventKind kind, const bytecode::Trap& trap, std::string_view reason,
            const PreparedProgram* other);
  ClockReading reading() { return {clock_.now_ns(), now_.time_ns, next_time_ns()}; }
  void publish_if_due();
  void publish();
  [[nodiscard]] TaskThreads::Hold hold_tasks();
  std::int64_t next_time_ns() const;
  std::int64_t safe_time_ns();
  void wait(std::int64_t timeout_ns);
  bool real() const { return config_.clock == ClockMode::Real; }

  const HostConfig& config_;
  AreaDriver& io_;
  PlantAccess* plant_;
  SnapshotWriter& snapshots_;
  record::RetainManager& retain_;
  MonotonicClock clock_;

  SpscQueue<Command> urgent_;  // stops and the supervisor's life: ahead of the others
  SpscQueue<Command> commands_;
  SpscQueue<Completion> completions_;
  std::vector<Completion> finished_;  // the scan thread's: commands of this turn; sized once
  WakeSignal wake_;
  Notifier news_;
  SeqCell<ScanFigures> figures_;
  SeqCell<ForceList> forces_;
  std::atomic<bool> quit_{false};
  std::atomic<bool> task_failed_{false};
  ThreadLiveness liveness_;

  // The rest belongs to the scan thread.
  PreparedProgram* program_ = nullptr;
  ThreadPlacement placement_;  // of the scan thread
  ScanFigures now_;
  std::int64_t origin_ns_ = 0;      // real clock: monotonic time at scan time 0
  std::int64_t next_start_ns_ = 0;  // scan time at which a start takes over
  std::int64_t idle_due_ns_ = 0;    // real clock: scan time of the next I/O while no program runs
  bool commands_left_ = false;      // real clock: there was no time for all of them before the scan
  std::uint64_t stopped_at_ = 0;    // order of the newest stop: starts that were asked for before it are void
  ClockGate gate_;
  FaultSchedule faults_;
  std::vector<double> truths_;
  scan::Histogram earlier_scans_;  // of the programs before
  std::uint64_t earlier_overruns_ = 0;
  std::int64_t published_ns_ = 0;
  std::int64_t timings_published_ns_ = 0;
  record::ScanTap tap_;
  ChangeTrial trial_;
  WarmChange warm_change_;
};

}  // namespace stepwright::host
