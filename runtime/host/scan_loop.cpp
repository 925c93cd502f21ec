#include "runtime/host/scan_loop.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace stepwright::host {
namespace {

constexpr std::size_t kQueue = 256;
// How often the figures of the tasks are published: they are large.
constexpr std::int64_t kTimingPeriodNs = 100'000'000;
constexpr std::int64_t kRecordingWaitNs = 1'000'000;
constexpr std::int64_t kFullRingWaitNs = 1'000'000;

// Why a program is at fault, beside its trap. No heap: it is the scan thread's.
FixedText<kMaxReasonBytes> reason_of(const scan::ScanCycle& cycle) {
  if (cycle.state() == scan::ScanState::Overrun)
    return FixedText<kMaxReasonBytes>("a task was late, and its overrun policy is fault");
  if (cycle.state() == scan::ScanState::IoLost) return FixedText<kMaxReasonBytes>(kIoLost);
  const scan::WatchdogReport& report = cycle.watchdog_report();
  if (report.took_ns == 0) return {};
  std::array<char, kMaxReasonBytes> text{};
  const int length = std::snprintf(
      text.data(), text.size(), "the watchdog expired: %lld us, %u in a row, of a task with %lld us x %u",
      static_cast<long long>(report.took_ns / 1'000), report.too_long,
      static_cast<long long>(report.limits.time_ns / 1'000), report.limits.sensitivity);
  return FixedText<kMaxReasonBytes>(std::string_view(text.data(), static_cast<std::size_t>(length)));
}

}  // namespace

ScanLoop::ScanLoop(const HostConfig& config, AreaDriver& io, PlantAccess* plant, SnapshotWriter& snapshots,
                   record::RetainManager& retain)
    : config_(config),
      io_(io),
      plant_(plant),
      snapshots_(snapshots),
      retain_(retain),
      urgent_(kQueue),
      commands_(kQueue),
      completions_(kQueue),
      liveness_(config.safety.stall_ns),
      gate_(config),
      faults_(config.faults),
      truths_(plant == nullptr ? 0 : plant->value_names().size()) {
  origin_ns_ = clock_.now_ns();
  placement_.cpu = config.cpu;  // HostRuntime gave it to the thread
  finished_.reserve(kQueue);
  publish();
}

void ScanLoop::run() {
  while (!quit_.load(std::memory_order_acquire)) {
    take_commands();
    if (real()) {
      report_task_failure();
      turn_real();
    } else {
      turn_simulated();
    }
  }
  const auto hold = hold_tasks();
  stop("the runtime ends");
  // Before anything that waits: for a disk, for another thread.
  io_.release_outputs();
  liveness_.rest();
  tap_.end("the runtime ends");
}

void ScanLoop::quit() {
  quit_.store(true, std::memory_order_release);
  wake_.notify();
}

bool ScanLoop::submit(Command command) {
  if (!(goes_ahead(command.kind) ? urgent_ : commands_).push(std::move(command))) return false;
  wake_.notify();
  return true;
}

void ScanLoop::turn_real() {
  if (program_ == nullptr) return wait(-1);
  const bool running = now_.state == RuntimeState::Running;
  const std::int64_t due_ns = running ? program_->cycle().next_time_ns() : idle_due_ns_;
  if (!reached(due_ns)) return;
  const std::int64_t late_ns = clock_.now_ns() - origin_ns_ - due_ns;
  if (!running) {
    idle_io(due_ns + late_ns);
    idle_due_ns_ = due_ns + late_ns + config_.idle_interval_ns;
    return publish_if_due();
  }
  PreparedProgram* const scanned = program_;
  const auto hold = hold_tasks();
  if (io_.lapsed()) {
    stop(kStoodStill, scan::SafeCause::Killed);
    return;
  }
  program_->cycle().settle_overruns(due_ns + late_ns);
  scan_once();
  // After a rollback the tasks of another program run, whose mutex is not held.
  if (program_ == scanned) program_->task_threads().look_at_triggers();
}

// Waits for the instant. False if something is to be done before it. One system call, but for what comes in
// between.
bool ScanLoop::reached(std::int64_t due_ns) {
  const std::int64_t instant_ns = origin_ns_ + due_ns;
  const bool far = instant_ns - clock_.now_ns() > kUndisturbedNs;
  if (far && (commands_left_ || warm_change_.waiting)) return false;
  liveness_.rest_until(instant_ns);
  const bool rang = far && !wake_.wait_until(instant_ns);
  const bool interrupted = rang && instant_ns - clock_.now_ns() > kUndisturbedNs;
  if (!interrupted && (rang || !far)) sleep_until(instant_ns);
  liveness_.busy();
  return !interrupted;
}

// Without a scan: the one of the leading task may be far away.
void ScanLoop::report_task_failure() {
  if (!task_failed_.load(std::memory_order_acquire)) return;
  task_failed_.store(false, std::memory_order_release);
  if (now_.state != RuntimeState::Running) return;
  const auto hold = hold_tasks();
  if (program_->cycle().state() == scan::ScanState::Running) return;
  const scan::ScanReport report = program_->cycle().report_fault();
  if (trial_.active() && tried(report)) return;
  if (tap_.recording()) tap_.state(record::StateCause::Tasks, running());
  faulted(report);
}

void ScanLoop::turn_simulated() {
  if (now_.state != RuntimeState::Running || !gate_.may_scan()) return wait(-1);
  // A full ring holds the clock too: no event is lost in simulated time. It may have room again although
  // nobody has rung: it was not full yet when the service began to take.
  if (program_->events().full()) return wait(kFullRingWaitNs);
  // So does a recording that cannot follow; its writer looks for news by itself.
  if (!tap_.has_room(program_->image().bytes().size())) return wait(kRecordingWaitNs);
  // What a person steps through waits for that person only.
  if (gate_.keeps_step()) {
    const std::int64_t early_ns = gate_.wait_ns(clock_.now_ns(), program_->cycle().next_time_ns());
    if (early_ns > 0) return wait(early_ns);
  }
  scan_once();
}

// At most until the next force ends.
void ScanLoop::wait(std::int64_t timeout_ns) {
  const std::int64_t end_ns = program_ == nullptr ? image::kNoEnd : program_->cycle().forces().next_end_ns();
  if (end_ns != image::kNoEnd) {
    const std::int64_t left_ns = std::max<std::int64_t>(0, end_ns - clock_.now_ns());
    timeout_ns = timeout_ns < 0 ? left_ns : std::min(timeout_ns, left_ns);
  }
  liveness_.rest();
  if (timeout_ns < 0) {
    wake_.wait();
  } else {
    wake_.wait_until(clock_.now_ns() + timeout_ns);
  }
  liveness_.busy();
}

void ScanLoop::scan_once() {
  liveness_.busy();
  faults_.inject_due(program_->cycle().next_time_ns(), plant_);
  if (tap_.recording() && !program_->task_threads().empty()) tap_.state(record::StateCause::Tasks, running());
  const scan::ScanReport report = program_->cycle().run_scan();
  now_.scan = report.scan;
  now_.time_ns = report.time_ns;
  now_.trace_hash = program_->cycle().trace_hash();
  now_.overruns = earlier_overruns_ + program_->cycle().statistics().overruns;
  const bool stands = gate_.scanned();
  const bool changed = program_->steps().changed(program_->image().bytes());
  // A scan that is taken back is no part of a recording.
  if (trial_.active() && tried(report)) return;
  if (tap_.recording()) {
    tap_.scanned(report,
                 {io_.inputs().first(program_->image().inputs().size()), io_.read_good(), io_.write_good()},
                 running());
  }
  if (report.state != scan::ScanState::Running) return faulted(report);
  retain_.offer(program_->image().bytes(), clock_.now_ns());
  if (changed) {
    gate_.stand(reading());
    emit(EventKind::StepChange, {}, {});
  } else if (stands) {
    publish();
    news_.notify();
  } else {
    publish_if_due();
  }
}

void ScanLoop::faulted(const scan::ScanReport& report) {
  retain_.finish(program_->image().bytes());
  gate_.rest(reading());
  program_->task_threads().stop();
  now_.state = RuntimeState::Fault;
  next_start_ns_ = program_->cycle().next_time_ns();
  if (real()) idle_due_ns_ = safe_time_ns();  // ramps go on at once
  emit(EventKind::Trap, report.trap, reason_of(program_->cycle()).view());
}

// Inputs stay fresh and outputs safe while no program runs. A driver that does not answer is no news then.
// Whoever had the outputs until now may have left ramps on their way: they go on from where they are.
void ScanLoop::idle_io(std::int64_t time_ns) {
  scan::ScanCycle& cycle = program_->cycle();
  if (io_.takes_over()) cycle.inherit_outputs(io_.outputs(), cycle.safe_state().cause(), time_ns);
  cycle.idle(time_ns);
  now_.time_ns = time_ns;
}

void ScanLoop::emit(EventKind kind, const bytecode::Trap& trap, std::string_view reason,
                    const PreparedProgram* other) {
  note(kind, trap, reason, other);
  news_.notify();
}

// The event without a notification: a command is followed by one anyway.
void ScanLoop::note(EventKind kind, const bytecode::Trap& trap, std::string_view reason,
                    const PreparedProgram* other) {
  EventNote event;
  event.sequence = now_.events.next();
  event.scan = now_.scan;
  event.time_ns = now_.time_ns;
  event.kind = kind;
  event.trap = trap;
  event.reason = FixedText<kMaxReasonBytes>(reason);
  event.cause = program_->cycle().safe_state().cause();
  event.other = other;
  if (plant_ != nullptr) plant_->read_values(truths_);
  // The figures first: who sees the event must find a status that is at least as new. After a change in real
  // time the scan is in a hurry: snapshot and distributions follow with the next turn.
  if (kind == EventKind::Changed && real()) {
    figures_.store(now_);
    published_ns_ = 0;
  } else {
    publish();
  }
  now_.events.handed_over(program_->events().push(event, program_->image().bytes(), truths_));
}

// The other tasks of the program neither take nor give values while it lives.
TaskThreads::Hold ScanLoop::hold_tasks() {
  return program_ == nullptr ? TaskThreads::Hold(nullptr) : program_->task_threads().hold();
}

void ScanLoop::publish_if_due() {
  if (clock_.now_ns() - published_ns_ >= kPublishPeriodNs) publish();
}

void ScanLoop::publish() {
  published_ns_ = clock_.now_ns();
  now_.waiting_for_supervisor = gate_.waits_for_supervisor();
  now_.realtime_factor = gate_.factor(published_ns_, now_.time_ns).value_or(now_.realtime_factor);
  if (program_ != nullptr) {
    scan::Histogram all = earlier_scans_;
    all.add(program_->cycle().statistics().scan_time);
    now_.scan_p50_ns = all.percentile_ns(50'000);
    now_.scan_p99_ns = all.percentile_ns(99'000);
    now_.scan_max_ns = all.max_ns();
    if (plant_ != nullptr) plant_->read_values(truths_);
    if (published_ns_ - timings_published_ns_ >= kTimingPeriodNs) {
      timings_published_ns_ = published_ns_;
      program_->publish_timings();
    }
    snapshots_.publish(now_.scan, now_.time_ns, program_->digest(), program_->image().bytes(), truths_);
  }
  figures_.store(now_);
}

// Where the safe state's time is while no program runs.
std::int64_t ScanLoop::safe_time_ns() {
  return real() ? clock_.now_ns() - origin_ns_ : now_.time_ns;
}

std::int64_t ScanLoop::next_time_ns() const {
  return now_.state == RuntimeState::Running ? program_->cycle().next_time_ns() : next_start_ns_;
}

}  // namespace stepwright::host
