#pragma once

// Safety settings of a cell: the safe state by cause and output, and the watchdogs of tasks. The guard
// process reads the same. All of it is in this header, as the guard links no host.
//
// Threads: plain data. Invariant: what `matrix` refers to is the table itself, which must outlive its use.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/naming/ascii_names.h"
#include "runtime/scan/safe_state.h"
#include "runtime/scan/task_watchdog.h"

namespace stepwright::host {

// The matrix cause x output. Outputs without a rule go to zero.
struct SafeTable {
  struct Column {
    std::vector<scan::SafeOutput> outputs;
    std::vector<scan::SafeRamp> ramps;  // kMaxRamps at most
  };
  std::array<Column, scan::kSafeCauses> columns;

  Column& of(scan::SafeCause cause) { return columns[static_cast<std::size_t>(cause)]; }
  const Column& of(scan::SafeCause cause) const { return columns[static_cast<std::size_t>(cause)]; }

  scan::SafeMatrix matrix() const {
    scan::SafeMatrix matrix;
    for (std::size_t i = 0; i < columns.size(); ++i) matrix[i] = {columns[i].outputs, columns[i].ramps};
    return matrix;
  }

  // The same for every cause.
  static SafeTable of_all_causes(const std::vector<scan::SafeOutput>& outputs) {
    SafeTable table;
    for (Column& column : table.columns) column.outputs = outputs;
    return table;
  }
};

struct NamedWatchdog {
  std::string task;  // as the program names it; upper and lower case alike
  scan::WatchdogLimits limits;
};

struct SafetyConfig {
  SafeTable safe_state;
  scan::WatchdogLimits watchdog;         // of tasks that have none of their own; real clock only
  std::vector<NamedWatchdog> watchdogs;  // by task
  std::int64_t monitor_ns = 20'000'000;  // how often the monitor looks
  std::int64_t stall_ns = 100'000'000;   // later than this, a scan thread does not come back

  // Of the task with this name.
  scan::WatchdogLimits watchdog_of(const std::string& task) const {
    for (const NamedWatchdog& named : watchdogs) {
      if (naming::same_name(named.task, task)) return named.limits;
    }
    return watchdog;
  }
};

}  // namespace stepwright::host
