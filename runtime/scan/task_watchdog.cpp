#include "runtime/scan/task_watchdog.h"

namespace stepwright::scan {

std::int64_t TaskWatchdog::longest_ns() const {
  if (!on()) return kNoLimit;
  return limits_.time_ns > kNoLimit / sensitivity() ? kNoLimit : limits_.time_ns * sensitivity();
}

bool TaskWatchdog::executed(std::int64_t took_ns) {
  if (!on()) return false;
  if (took_ns <= limits_.time_ns) {
    too_long_ = 0;
    return false;
  }
  ++too_long_;
  return too_long_ >= sensitivity() || took_ns > longest_ns();
}

}  // namespace stepwright::scan
