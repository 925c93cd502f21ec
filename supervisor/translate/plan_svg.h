#pragma once

// A picture of a plan: its schedule as a Gantt chart (the bar is the earliest time, the pale one behind it
// the slack, a dark frame marks what is critical), and below it the causal graph: which action waits for
// which, and for what. Both have their keys; the graph is broken into bands as wide as the schedule. It has
// a size of its own, and colours for light and dark pages.
//
// Pure function.
//
//   write(plan_svg(run, *schedule(run, binding, false)));

#include <string>

#include "supervisor/model/planned_run.h"
#include "supervisor/translate/schedule.h"

namespace stepwright::translate {

// `schedule` is of `run`. `unit` stands behind the times: "s", or "steps" of a schedule without durations.
std::string plan_svg(const model::PlannedRun& run, const Schedule& schedule, const std::string& unit = "s");

}  // namespace stepwright::translate
