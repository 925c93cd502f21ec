#pragma once

// One run of the campaign: the bench with its real planner, compiler, scan and plant in one thread,
// disturbed, and judged by the plant's truth. A run is lost if it ends otherwise than at the goal or in the
// safe state, if it says the goal is reached and it is not, or if it gives up without need or with a reason
// that cannot be.

#include <cstdint>
#include <string>

#include "cell/campaign/verdict.h"
#include "supervisor/run/run_record.h"
#include "tests/bench/campaign/disturbance.h"

namespace stepwright::campaign {

struct RunResult {
  Disturbance disturbance;
  Verdict verdict = Verdict::Lost;
  std::string why;  // of a lost run
  run::RunRecord record;
  double level_error = 0.0;  // at the goal: the larger of a1 and a2, in plan levels
  double wall_ms = 0.0;
};

// The service of tests/cells/bench, with reports on the metric.
[[nodiscard]] result::Result<executive::PlanningService> campaign_planning();

RunResult run_once(const executive::PlanningService& planning, const Disturbance& disturbance);

}  // namespace stepwright::campaign
