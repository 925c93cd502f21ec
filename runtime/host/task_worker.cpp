#include "runtime/host/task_worker.h"

#include <cstring>
#include <mutex>
#include <utility>

namespace stepwright::host {
namespace {

// How often the figures of a task are published.
constexpr std::int64_t kFiguresPeriodNs = 100'000'000;

}  // namespace

TaskWorker::TaskWorker(WorkerShare& share, const scan::Task& task, std::unique_ptr<bytecode::Engine> engine,
                       const ThreadPlacement& placement, SeqCell<scan::TaskTiming>& timing)
    : share_(share),
      task_(task),
      engine_(std::move(engine)),
      published_(timing),
      memory_(share.program.memory_size()),
      before_(share.program.image_size()),
      liveness_(share.stall_ns),
      watch_(share.monitor, liveness_),
      wake_ns_(scan::kNever) {
  engine_->set_interrupt(liveness_.interrupt());
  thread_ = std::thread([this, placement] { run(placement); });
}

TaskWorker::~TaskWorker() {
  quit_.store(true, std::memory_order_release);
  wake_.notify();
  thread_.join();
}

void TaskWorker::start(std::int64_t time_ns) {
  task_.restart(time_ns);
  go_on();
}

void TaskWorker::take_over(const scan::Task* before, std::int64_t time_ns) {
  task_.restart(time_ns);
  if (before != nullptr) task_.take_over(*before, time_ns);
  go_on();
}

void TaskWorker::go_on() {
  timing_.interrupted();
  active_ = true;
  pending_ = false;
  wake_ns_.store(task_.due_ns, std::memory_order_release);
  wake_.notify();
}

void TaskWorker::rest() {
  active_ = false;
  wake_ns_.store(scan::kNever, std::memory_order_release);
  wake_.notify();
}

// An edge while the one before still waits for its cycle is lost, as it is between two scans.
void TaskWorker::look_at_trigger() {
  if (!task_.has_trigger() || !active_) return;
  const bool now = task_.trigger_now(share_.image.bytes());
  const bool edge = now && !task_.triggered;
  task_.triggered = now;
  if (!edge) return;
  if (pending_) ++timing_.overruns;
  pending_ = true;
  wake_.notify();
}

void TaskWorker::run(const ThreadPlacement& placement) {
  // What is refused here was refused to the scan thread as well, which says so.
  static_cast<void>(place_thread(placement));
  while (!quit_.load(std::memory_order_acquire)) {
    wait();
    cycle();
  }
}

// Until the task is due or somebody wakes it. One system call.
void TaskWorker::wait() {
  const std::int64_t due_ns = wake_ns_.load(std::memory_order_acquire);
  if (due_ns == scan::kNever) return wake_.wait();
  wake_.wait_until(share_.origin_ns + due_ns);
}

void TaskWorker::cycle() {
  std::int64_t time_ns = 0;
  scan::TaskCycle measured;
  if (!take(time_ns, measured)) return;
  std::memcpy(before_.data(), memory_.data(), before_.size());
  std::uint64_t budget = share_.budget;
  const scan::ExecutionPlace place{share_.program, *engine_, memory_, share_.clock, &liveness_, true};
  const scan::Execution done = scan::execute(place, task_, time_ns, budget);
  // Between two executions nobody waits for this task.
  liveness_.rest();
  give_back(done, measured);
}

// The copy of the image for a cycle that is to run now, at scan time `time_ns`; false if none is.
bool TaskWorker::take(std::int64_t& time_ns, scan::TaskCycle& measured) {
  const std::lock_guard lock(share_.mutex);
  if (!share_.running || !active_) return false;
  const std::int64_t now_ns = share_.clock.now_ns() - share_.origin_ns;
  const bool due = task_.due_ns <= now_ns;
  if (!due && !pending_) return false;
  const scan::Overrun overrun = due ? scan::settle_overrun(task_, now_ns) : scan::Overrun{};
  timing_.overruns += overrun.missed;
  timing_.skipped += overrun.skipped;
  share_.cycle.foreign_overrun(overrun, now_ns);
  tell_of_fault();
  // An event runs at the instant at which it is found, a cycle at the instant at which it was due.
  time_ns = due && !pending_ ? task_.due_ns : now_ns;
  if (due && !pending_ && !task_.freewheeling) {
    measured.due_ns = share_.origin_ns + task_.wanted_ns;
    measured.interval_ns = task_.interval_ns;
  }
  if (due) {
    task_.due_at(task_.freewheeling ? now_ns + scan::kFreewheelRestNs : task_.due_ns + task_.interval_ns);
    wake_ns_.store(task_.due_ns, std::memory_order_release);
  }
  // While its trigger is TRUE the interval does not run a task (IEC 61131-3, table 63).
  const bool held = task_.has_trigger() && task_.triggered;
  if (!pending_ && held) return false;
  pending_ = false;
  if (!share_.cycle.begin_foreign(now_ns)) return tell_of_fault();
  epoch_ = share_.epoch;
  const std::span<const std::byte> shared = share_.image.bytes();
  std::memcpy(memory_.data(), shared.data(), shared.size());
  share_.cycle.forces().apply(std::span(memory_).first(before_.size()));
  return true;
}

void TaskWorker::give_back(const scan::Execution& done, scan::TaskCycle measured) {
  const std::lock_guard lock(share_.mutex);
  measured.begin_ns = done.begin_ns;
  measured.end_ns = done.end_ns;
  timing_.cycle(measured);
  timing_.too_long = task_.watchdog.too_long();
  if (done.watchdog.took_ns > 0) {
    ++timing_.watchdog_expiries;
    published_ns_ = 0;  // nothing may follow that would bring it
  }
  publish_if_due(measured.end_ns);
  if (!share_.running || share_.epoch != epoch_) return;
  const std::span<std::byte> after = std::span(memory_).first(before_.size());
  if (!done.trap) {
    share_.merge_map.merge(before_, after, share_.image.bytes());
    share_.cycle.forces().apply(share_.image.bytes());
  }
  share_.cycle.end_foreign(measured.end_ns - share_.origin_ns, done);
  tell_of_fault();
  share_.wake_others();
}

// The leading task may not be due for long: the thread that scans hears of a fault now. False if nothing
// runs.
bool TaskWorker::tell_of_fault() {
  if (share_.cycle.state() == scan::ScanState::Running) return true;
  share_.failed();
  return false;
}

void TaskWorker::publish_if_due(std::int64_t now_ns) {
  if (now_ns - published_ns_ < kFiguresPeriodNs) return;
  published_ns_ = now_ns;
  published_.store(timing_);
}

}  // namespace stepwright::host
