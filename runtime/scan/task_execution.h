#pragma once

// One execution of a task: its programs once, in time or not.
//
// Threads: that of the engine. No heap, lock or log.

#include <cstdint>
#include <span>

#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/program.h"
#include "runtime/scan/clock.h"
#include "runtime/scan/task_table.h"
#include "runtime/scan/task_watchdog.h"

namespace stepwright::scan {

// Where tasks are executed.
struct ExecutionPlace {
  const bytecode::Program& program;
  bytecode::Engine& engine;
  std::span<std::byte> memory;  // image and frames
  Clock& clock;
  TaskWatch* watch = nullptr;  // told of every execution
  bool measured = false;       // begin and end are wanted
};

// Why a watchdog expired; took_ns is 0 if none did.
struct WatchdogReport {
  std::uint32_t task = 0;  // index in the container
  std::int64_t took_ns = 0;
  WatchdogLimits limits;
  std::uint32_t too_long = 0;  // executions in a row
};

struct Execution {
  bytecode::Trap trap;      // what ended it; of a watchdog that expired, too
  bool late = false;        // its watchdog expired, and nothing else was wrong
  WatchdogReport watchdog;  // if its watchdog expired
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
};

// Takes what it used from `budget`, unless the task's watchdog can end it: then it has time and no budget.
Execution execute(const ExecutionPlace& place, Task& task, std::int64_t time_ns, std::uint64_t& budget);

}  // namespace stepwright::scan
