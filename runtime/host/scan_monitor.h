#pragma once

// Monitors the scanning threads from outside. Each scanning thread has a ThreadLiveness, in which it says by
// when it will report again; the monitor's own thread looks at all of them. An execution that lasts beyond
// what its watchdog allows is ended through the engine's interrupt; a thread that does not report (a driver
// that blocks, a deadlock) cannot be ended from inside the process: then the runtime is not healthy, and its
// heartbeat to the guard and systemd stops.
//
//   ScanMonitor monitor(20'000'000, [&] { driver.beat(); });
//   monitor.watch(loop.liveness());
//   monitor.start();
//   if (!monitor.healthy()) ...                       // any thread
//
// Threads: a ThreadLiveness's functions belong to its scanning thread, unless they say otherwise; no heap,
// lock or system call in them. start by one thread; watch, unwatch, healthy and silent_ns by any that does
// not scan.

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "runtime/bytecode/interrupt.h"
#include "runtime/host/notifier.h"
#include "runtime/host/real_time.h"
#include "runtime/scan/task_watchdog.h"

namespace stepwright::host {

class ThreadLiveness final : public scan::TaskWatch {
 public:
  // `stall_ns`: how much later than it said the thread may be.
  explicit ThreadLiveness(std::int64_t stall_ns) : stall_ns_(stall_ns) {}

  // The thread waits until that instant of the monotonic clock, or as long as nobody wants anything of it.
  void rest_until(std::int64_t instant_ns) { expect(instant_ns); }
  void rest() { heard_until_ns_.store(kNever, std::memory_order_relaxed); }
  // The thread does what takes no time worth mentioning: I/O, commands, bookkeeping.
  void busy() { expect(clock_.now_ns()); }

  // An execution of a program; without a limit the budget of the scan ends it.
  void begin(std::int64_t until_ns) override;
  void end() override;
  const bytecode::Interrupt* interrupt() const override { return &interrupt_; }

  // The monitor's thread: ends an execution that has lasted too long; how long the thread should have been
  // heard of, 0 if it has time.
  void end_if_late(std::int64_t now_ns);
  std::int64_t silent_ns(std::int64_t now_ns) const;

 private:
  static constexpr std::int64_t kNever = scan::TaskWatchdog::kNoLimit;

  void expect(std::int64_t instant_ns) {
    heard_until_ns_.store(instant_ns + stall_ns_, std::memory_order_relaxed);
  }

  MonotonicClock clock_;
  std::int64_t stall_ns_;
  bytecode::Interrupt interrupt_;
  std::atomic<std::int64_t> execution_until_ns_{kNever};
  std::atomic<std::int64_t> heard_until_ns_{kNever};
};

class ScanMonitor {
 public:
  // Looks every `period_ns` and calls `beat` on its thread whenever all is well: no lock, nothing that waits.
  ScanMonitor(std::int64_t period_ns, std::function<void()> beat);
  ~ScanMonitor();
  ScanMonitor(const ScanMonitor&) = delete;
  ScanMonitor& operator=(const ScanMonitor&) = delete;

  // Looks at it until unwatch, or for the rest of the monitor's life. Any thread but a scanning one.
  void watch(ThreadLiveness& liveness);
  void unwatch(ThreadLiveness& liveness);
  void start();

  // Every thread was heard of in time when the monitor looked last.
  bool healthy() const { return silent_ns() == 0; }
  // How long the one that has been silent longest should have been heard of.
  std::int64_t silent_ns() const { return silent_ns_.load(std::memory_order_relaxed); }

 private:
  void run();

  std::int64_t period_ns_;
  std::function<void()> beat_;
  std::mutex mutex_;  // of the list; never taken by a thread that scans
  std::vector<ThreadLiveness*> watched_;
  MonotonicClock clock_;
  Notifier end_;
  std::atomic<bool> quit_{false};
  std::atomic<std::int64_t> silent_ns_{0};
  std::thread thread_;
};

// Registers a ThreadLiveness with a monitor for its own lifetime (RAII).
class MonitorWatch {
 public:
  // Null: nobody looks. Both must outlive it.
  MonitorWatch(ScanMonitor* monitor, ThreadLiveness& liveness) : monitor_(monitor), liveness_(liveness) {
    if (monitor_ != nullptr) monitor_->watch(liveness_);
  }
  ~MonitorWatch() {
    if (monitor_ != nullptr) monitor_->unwatch(liveness_);
  }
  MonitorWatch(const MonitorWatch&) = delete;
  MonitorWatch& operator=(const MonitorWatch&) = delete;

 private:
  ScanMonitor* monitor_;
  ThreadLiveness& liveness_;
};

}  // namespace stepwright::host
