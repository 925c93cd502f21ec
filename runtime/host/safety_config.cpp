#include "runtime/host/safety_config.h"

#include "runtime/naming/ascii_names.h"

namespace stepwright::host {

scan::WatchdogLimits SafetyConfig::watchdog_of(const std::string& task) const {
  for (const NamedWatchdog& named : watchdogs) {
    if (naming::same_name(named.task, task)) return named.limits;
  }
  return watchdog;
}

}  // namespace stepwright::host
