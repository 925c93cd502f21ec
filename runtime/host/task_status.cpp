#include "runtime/host/task_status.h"

#include "runtime/host/duration_counts.h"
#include "runtime/host/limits.h"

namespace stepwright::host {

DurationSpread spread_of(const scan::Histogram& durations) {
  const auto us = [](std::int64_t ns) { return static_cast<double>(ns) / 1'000.0; };
  return {us(durations.percentile_ns(50'000)), us(durations.percentile_ns(99'000)),
          us(durations.percentile_ns(99'900)), us(durations.percentile_ns(99'990)), us(durations.max_ns())};
}

TaskDetail task_detail(const TaskPlan::Entry& task, const scan::WatchdogLimits& watchdog,
                       const scan::TaskTiming& timing) {
  TaskDetail detail;
  detail.name = task.name.substr(0, kMaxNameBytes);
  if (watchdog.time_ns > 0) {
    detail.watchdog_us = static_cast<std::uint64_t>(watchdog.time_ns) / 1'000;
    detail.watchdog_sensitivity = watchdog.sensitivity;
  }
  detail.too_long = timing.too_long;
  detail.watchdog_expiries = timing.watchdog_expiries;
  detail.latency = counts_of(timing.latency);
  detail.execution = counts_of(timing.execution);
  detail.jitter = counts_of(timing.jitter);
  return detail;
}

TaskStatus task_status(const TaskPlan::Entry& task, const scan::TaskTiming& timing) {
  TaskStatus status;
  status.name = task.name.substr(0, kMaxNameBytes);
  status.interval_us = task.interval_us;
  status.priority = task.priority;
  status.cycles = timing.cycles;
  status.overruns = timing.overruns;
  status.skipped = timing.skipped;
  status.latency = spread_of(timing.latency);
  status.execution = spread_of(timing.execution);
  status.jitter = spread_of(timing.jitter);
  return status;
}

}  // namespace stepwright::host
