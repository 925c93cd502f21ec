#pragma once

// Plan of the tasks of one program in this runtime: which of them the scan thread runs itself, which get a
// thread of their own, how urgent each is, and what the configuration says of them.
//
// In simulated time the scan thread runs all, one after the other, so that equal inputs give equal traces. In
// real time every task has a thread: the scan thread leads, that is, it runs the cyclic task of the highest
// priority and does the housekeeping of the scan beside it.
//
// Threads: immutable; any.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/host/host_config.h"
#include "runtime/host/real_time.h"
#include "runtime/host/task_settings.h"

namespace stepwright::host {

struct TaskPlan {
  struct Entry {
    std::string name;
    std::uint32_t interval_us = 0;
    std::uint32_t priority = 0;
    ThreadPlacement placement;
  };
  std::vector<Entry> tasks;                // in the order of the container
  std::vector<scan::TaskOptions> options;  // the same
  std::uint32_t leader = 0;                // index of the task that the scan thread runs
  std::uint32_t own_tasks = 0;             // bit i: the scan thread runs task i
  std::string unknown;                     // names in the configuration that no task has, for the status

  // The indexes of the tasks that get threads of their own.
  std::vector<std::uint32_t> others() const;
};

// A phase beyond the task's interval is taken modulo the interval.
TaskPlan plan_tasks(std::span<const reader::TaskInfo> tasks, const HostConfig& config);

}  // namespace stepwright::host
