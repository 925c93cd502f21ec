#pragma once

// The figures of a task as the status shows them.
//
// Threads: any.

#include "runtime/host/messages.h"
#include "runtime/host/task_plan.h"
#include "runtime/scan/task_timing.h"
#include "runtime/scan/task_watchdog.h"

namespace stepwright::host {

DurationSpread spread_of(const scan::Histogram& durations);

TaskDetail task_detail(const TaskPlan::Entry& task, const scan::WatchdogLimits& watchdog,
                       const scan::TaskTiming& timing);

TaskStatus task_status(const TaskPlan::Entry& task, const scan::TaskTiming& timing);

}  // namespace stepwright::host
