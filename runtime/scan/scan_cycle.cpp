#include "runtime/scan/scan_cycle.h"

#include <cassert>

#include "runtime/base/hash64.h"

namespace stepwright::scan {

using bytecode::Section;

ScanCycle::ScanCycle(const bytecode::Program& program, bytecode::Engine& engine, image::ProcessImage& image,
                     std::span<std::byte> safe_outputs, image::IoDriver& io, Clock& clock,
                     const ScanConfig& config)
    : program_(program),
      engine_(engine),
      image_(image),
      io_(io),
      clock_(clock),
      config_(config),
      table_(program, config.tasks, config.own_tasks),
      safe_(config.safe_state, safe_outputs) {
  assert(image.memory().size() == program.memory_size());
  assert(safe_outputs.size() >= image.outputs().size());
  assert(safe_outputs.empty() || safe_outputs.data() != image.outputs().data());
  engine_.set_interrupt(config_.watch == nullptr ? nullptr : config_.watch->interrupt());
}

image::ImageLayout layout_of(const bytecode::Program& program) {
  const bytecode::SizesRecord& sizes = program.sizes();
  return {sizes.input_bytes, sizes.output_bytes, sizes.marker_bytes, sizes.data_bytes,
          program.memory_size() - program.image_size()};
}

void ScanCycle::start(const StartPoint& at) {
  image_.reset(program_.container().section(Section::InitialData));
  forces_.clear_all();
  for (Task& task : table_.tasks()) task.restart(at.time_ns);
  for (TaskTiming& timing : config_.timings) timing.interrupted();
  scan_ = at.scan;
  last_time_ns_ = at.time_ns;
  io_time_ns_ = at.time_ns;
  trace_hash_ = at.trace_hash;
  last_trap_ = {};
  fault_reported_ = true;
  watchdog_report_ = {};
  state_ = ScanState::Running;
}

void ScanCycle::stop(SafeCause cause, std::int64_t time_ns) {
  if (state_ == ScanState::Running) safe_.enter(cause, time_ns);
  state_ = ScanState::Stopped;
  write_outputs(time_ns);
}

void ScanCycle::inherit_outputs(std::span<const std::byte> driven, SafeCause cause, std::int64_t time_ns) {
  assert(state_ != ScanState::Running);
  last_time_ns_ = time_ns;
  safe_.driven(driven);
  safe_.enter(cause, time_ns);
}

void ScanCycle::take_over(const ScanCycle& before, std::span<const std::uint32_t> counterparts) {
  assert(before.state_ != ScanState::Stopped);
  const std::int64_t next_ns = before.next_time_ns();
  for (Task& task : table_.tasks()) {
    assert(task.index < counterparts.size());
    task.restart(next_ns);
    for (const Task& other : before.table_.tasks()) {
      if (other.index == counterparts[task.index]) task.take_over(other, next_ns);
    }
  }
  scan_ = before.scan_;
  last_time_ns_ = before.last_time_ns_;
  io_time_ns_ = before.io_time_ns_;
  trace_hash_ = before.trace_hash_;
  statistics_ = before.statistics_;
  last_trap_ = {};
  watchdog_report_ = {};
  fault_reported_ = true;
  // What a safe state would hold is what is driven now.
  if (before.state_ == ScanState::Running) safe_.driven(before.safe_.outputs());
  state_ = ScanState::Running;
}

// A driver that does not answer is no news while nothing runs.
void ScanCycle::idle(std::int64_t time_ns) {
  assert(state_ != ScanState::Running);
  read_inputs(time_ns);
  write_outputs(time_ns);
}

// A fault outside of run_scan is reported by the next one.
void ScanCycle::fail(ScanState state, SafeCause cause, std::int64_t time_ns) {
  state_ = state;
  fault_reported_ = false;
  safe_.enter(cause, time_ns);
}

void ScanCycle::fail(const Execution& done, std::int64_t time_ns) {
  last_trap_ = done.trap;
  watchdog_report_ = done.watchdog;
  const bool endless = done.trap.code == bytecode::TrapCode::Watchdog;
  fail(done.late ? ScanState::WatchdogExpired : ScanState::Trapped,
       endless ? SafeCause::Watchdog : SafeCause::Trap, time_ns);
  ++(done.late ? statistics_.watchdogs : statistics_.traps);
}

void ScanCycle::settle_overruns(std::int64_t time_ns) {
  for (Task& task : table_.tasks()) {
    const Overrun overrun = settle_overrun(task, time_ns);
    if (overrun.missed == 0 && overrun.skipped == 0) continue;
    if (task.index < config_.timings.size()) {
      config_.timings[task.index].overruns += overrun.missed;
      config_.timings[task.index].skipped += overrun.skipped;
    }
    foreign_overrun(overrun, time_ns);
  }
}

CyclePoint ScanCycle::point() const {
  CyclePoint point{state_, scan_, last_time_ns_, trace_hash_, 0, {}};
  for (const Task& task : table_.tasks()) {
    point.tasks[point.task_count++] = {task.index, task.due_ns, task.triggered};
  }
  return point;
}

void ScanCycle::resume(const CyclePoint& point) {
  assert(point.task_count == table_.tasks().size());
  state_ = point.state;
  fault_reported_ = true;
  scan_ = point.scan;
  last_time_ns_ = io_time_ns_ = point.last_time_ns;
  trace_hash_ = point.trace_hash;
  last_trap_ = {};
  watchdog_report_ = {};
  std::uint32_t i = 0;
  for (Task& task : table_.tasks()) {
    task.due_at(point.tasks[i].due_ns);
    task.triggered = point.tasks[i++].triggered;
  }
  if (state_ == ScanState::Running) safe_.driven(image_.outputs());
}

void ScanCycle::skip_to(std::int64_t time_ns) {
  for (Task& task : table_.tasks()) {
    if (task.due_ns >= time_ns) continue;  // also what waits for its trigger only
    const std::int64_t missed = (time_ns - task.due_ns + task.interval_ns - 1) / task.interval_ns;
    task.due_at(task.freewheeling ? time_ns : task.due_ns + missed * task.interval_ns);
  }
}

void ScanCycle::foreign_overrun(const Overrun& overrun, std::int64_t time_ns) {
  statistics_.overruns += overrun.missed;
  if (!overrun.fault || overrun.missed == 0 || state_ != ScanState::Running) return;
  fail(ScanState::Overrun, SafeCause::Watchdog, time_ns);
  write_outputs(time_ns);
}

bool ScanCycle::begin_foreign(std::int64_t time_ns) {
  if (state_ != ScanState::Running) return false;
  read_inputs(time_ns);
  if (state_ != ScanState::Running) write_outputs(time_ns);
  return state_ == ScanState::Running;
}

void ScanCycle::end_foreign(std::int64_t time_ns, const Execution& done) {
  if (state_ != ScanState::Running) return;
  if (done.trap) fail(done, time_ns);
  if (!holds_outputs()) write_outputs(time_ns);
}

// A program on trial that failed: another one drives the outputs from the next scan on.
bool ScanCycle::holds_outputs() const {
  return hold_outputs_on_trap_ && (state_ == ScanState::Trapped || state_ == ScanState::WatchdogExpired);
}

ScanReport ScanCycle::run_scan() {
  const std::int64_t begin_ns = clock_.now_ns();
  const std::int64_t time_ns = next_time_ns();
  last_time_ns_ = time_ns;
  ++scan_;

  read_inputs(time_ns);
  if (state_ == ScanState::Running) run_tasks(time_ns);
  advance(time_ns);
  if (!holds_outputs()) write_outputs(time_ns);

  const ScanReport report = this->report(time_ns);
  trace_hash_ = base::hash_mix(base::hash_mix(trace_hash_, scan_), report.image_hash);
  ++statistics_.scans;
  statistics_.scan_time.record(clock_.now_ns() - begin_ns);
  return report;
}

ScanReport ScanCycle::report(std::int64_t time_ns) {
  ScanReport report{state_, scan_, time_ns, image_.hash(), {}};
  const bool program_failed = state_ == ScanState::Trapped || state_ == ScanState::WatchdogExpired;
  if (program_failed && !fault_reported_) report.trap = last_trap_;
  fault_reported_ = true;
  return report;
}

ScanReport ScanCycle::report_fault() {
  assert(state_ != ScanState::Running);
  return report(last_time_ns_);
}

// A task on another thread may have spoken to the driver after this scan was due and before it began.
std::int64_t ScanCycle::io_time(std::int64_t time_ns) {
  if (time_ns > io_time_ns_) io_time_ns_ = time_ns;
  return io_time_ns_;
}

void ScanCycle::read_inputs(std::int64_t time_ns) {
  const bool good = io_.read_inputs(io_time(time_ns), image_.inputs()) == image::IoStatus::Good;
  if (good || state_ != ScanState::Running) return;
  fail(ScanState::IoLost, SafeCause::IoLost, time_ns);
  ++statistics_.io_losses;
}

// A rising edge of the trigger runs the task; while the trigger is TRUE its interval does not (IEC 61131-3,
// table 63: SINGLE and INTERVAL).
bool ScanCycle::is_to_run(Task& task, std::int64_t time_ns) const {
  const bool due = task.due_ns == time_ns;
  if (!task.has_trigger()) return due;
  const bool now = task.trigger_now(image_.bytes());
  const bool edge = now && !task.triggered;
  task.triggered = now;
  return edge || (due && !now);
}

// The tasks that are due, forces before and after them. A trap ends the scan's tasks.
void ScanCycle::run_tasks(std::int64_t time_ns) {
  const std::int64_t begin_ns = clock_.now_ns();
  forces_.apply(image_.bytes());
  std::uint64_t budget = config_.budget;
  const ExecutionPlace place{program_, engine_,       image_.memory(),
                             clock_,   config_.watch, !config_.timings.empty()};
  for (Task& task : table_.tasks()) {
    const bool due = task.due_ns == time_ns;
    if (!is_to_run(task, time_ns)) continue;
    const Execution done = execute(place, task, time_ns, budget);
    account(task, due, done);
    if (!done.trap) continue;
    fail(done, time_ns);
    break;
  }
  forces_.apply(image_.bytes());
  statistics_.program_time.record(clock_.now_ns() - begin_ns);
}

void ScanCycle::account(const Task& task, bool due, const Execution& done) {
  if (task.index >= config_.timings.size()) return;
  TaskCycle cycle{.begin_ns = done.begin_ns, .end_ns = done.end_ns};
  if (real() && due && !task.freewheeling) {
    cycle.due_ns = config_.clock_origin_ns + task.wanted_ns;
    cycle.interval_ns = task.interval_ns;
  }
  TaskTiming& timing = config_.timings[task.index];
  timing.cycle(cycle);
  timing.too_long = task.watchdog.too_long();
  if (done.watchdog.took_ns > 0) ++timing.watchdog_expiries;
}

void ScanCycle::advance(std::int64_t time_ns) {
  for (Task& task : table_.tasks()) {
    if (task.due_ns != time_ns) continue;
    const bool at_once = task.freewheeling && real();
    task.due_at(at_once ? clock_.now_ns() - config_.clock_origin_ns + kFreewheelRestNs
                        : task.due_ns + task.interval_ns);
  }
}

void ScanCycle::make_safe(std::int64_t time_ns) {
  safe_.apply(time_ns, image_.outputs());
  io_.safe(static_cast<std::uint8_t>(safe_.cause()), safe_.settled());
}

// In any state but Running the outputs are in their safe state, forces or not.
void ScanCycle::write_outputs(std::int64_t time_ns) {
  if (state_ != ScanState::Running) make_safe(time_ns);
  const bool written = io_.write_outputs(io_time(time_ns), image_.outputs()) == image::IoStatus::Good;
  if (state_ != ScanState::Running) return;
  if (written) return safe_.driven(image_.outputs());
  fail(ScanState::IoLost, SafeCause::IoLost, time_ns);
  ++statistics_.io_losses;
  make_safe(time_ns);
  // The device may be reachable for this last word; nothing more can be done if it is not.
  static_cast<void>(io_.write_outputs(io_time(time_ns), image_.outputs()));
}

}  // namespace stepwright::scan
