#pragma once

// When each action should run, from the binding's nominal durations: the partial order's earliest start, or
// the strict sequence of the paper beside it.

#include <vector>

#include "runtime/result/result.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate {

struct ScheduledAction {
  double start_s = 0.0;
  double finish_s = 0.0;  // rest included
};

struct Schedule {
  std::vector<ScheduledAction> actions;  // as in the plan; 0 = the chart's start
  double makespan_s = 0.0;               // until DONE, settling included
};

// Fails with T0001 to T0003 as `translate`.
[[nodiscard]] result::Result<Schedule> schedule(const model::PlannedRun& run, const Binding& binding,
                                                bool sequential);

}  // namespace stepwright::translate
