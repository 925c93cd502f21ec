#include "runtime/scan/task_timing.h"

namespace stepwright::scan {

void TaskTiming::cycle(const TaskCycle& at) {
  ++cycles;
  execution.record(at.end_ns - at.begin_ns);
  if (at.due_ns != TaskCycle::kNone) latency.record(at.begin_ns - at.due_ns);
  if (at.interval_ns != TaskCycle::kNone && last_begin_ns != TaskCycle::kNone) {
    const std::int64_t off_ns = at.begin_ns - last_begin_ns - at.interval_ns;
    jitter.record(off_ns < 0 ? -off_ns : off_ns);
  }
  last_begin_ns = at.begin_ns;
}

}  // namespace stepwright::scan
