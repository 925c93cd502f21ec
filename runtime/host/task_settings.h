#pragma once

// Settings of one task by its name ([tasks.NAME] of the configuration). Plain data; any thread.

#include <cstdint>
#include <string>

#include "runtime/scan/task_options.h"

namespace stepwright::host {

struct TaskSettings {
  std::string name;           // as the program declares it; upper and lower case alike
  std::int64_t phase_ns = 0;  // scan::TaskOptions
  scan::OverrunPolicy overrun = scan::OverrunPolicy::Skip;
  int cpu = -1;  // the only processor its thread runs on; -1: any
};

}  // namespace stepwright::host
