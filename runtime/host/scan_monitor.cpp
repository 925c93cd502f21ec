#include "runtime/host/scan_monitor.h"

#include <algorithm>
#include <utility>

namespace stepwright::host {

void ThreadLiveness::begin(std::int64_t until_ns) {
  execution_until_ns_.store(until_ns, std::memory_order_relaxed);
  until_ns == kNever ? rest() : expect(until_ns);
  interrupt_.begin();
}

void ThreadLiveness::end() {
  interrupt_.end();
  busy();
}

// The number of the run is read before its limit: if another run begins meanwhile, `ask` finds that the first
// has ended.
void ThreadLiveness::end_if_late(std::int64_t now_ns) {
  const std::uint32_t run = interrupt_.running();
  if (run != 0 && now_ns > execution_until_ns_.load(std::memory_order_relaxed)) interrupt_.ask(run);
}

std::int64_t ThreadLiveness::silent_ns(std::int64_t now_ns) const {
  return std::max<std::int64_t>(0, now_ns - heard_until_ns_.load(std::memory_order_relaxed));
}

ScanMonitor::ScanMonitor(std::int64_t period_ns, std::function<void()> beat)
    : period_ns_(period_ns), beat_(std::move(beat)) {}

ScanMonitor::~ScanMonitor() {
  if (!thread_.joinable()) return;
  quit_.store(true, std::memory_order_release);
  end_.notify();
  thread_.join();
}

void ScanMonitor::watch(ThreadLiveness& liveness) {
  const std::lock_guard lock(mutex_);
  watched_.push_back(&liveness);
}

void ScanMonitor::unwatch(ThreadLiveness& liveness) {
  const std::lock_guard lock(mutex_);
  std::erase(watched_, &liveness);
}

void ScanMonitor::start() {
  thread_ = std::thread([this] { run(); });
}

void ScanMonitor::run() {
  enter_monitor_priority();
  while (!quit_.load(std::memory_order_acquire)) {
    const std::int64_t now_ns = clock_.now_ns();
    std::int64_t silent_ns = 0;
    {
      const std::lock_guard lock(mutex_);
      for (ThreadLiveness* liveness : watched_) {
        liveness->end_if_late(now_ns);
        silent_ns = std::max(silent_ns, liveness->silent_ns(now_ns));
      }
    }
    silent_ns_.store(silent_ns, std::memory_order_relaxed);
    if (silent_ns == 0) beat_();
    end_.wait(period_ns_);
  }
}

}  // namespace stepwright::host
