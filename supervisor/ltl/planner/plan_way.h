#pragma once

// The way of a plan as states along it, for pictures and reports: the planner's own integration, looked at
// again and again. A pure function; any thread.
//
//   for (const WayState& at : way_of(problem.train, answer->plan)) ...

#include <vector>

#include "supervisor/ltl/train/train_plan.h"

namespace stepwright::ltl {

struct WayState {
  double time_s = 0.0;
  TrainState state{};
};

// From the start to the end, each `every_s` seconds or less, and where a control ends.
std::vector<WayState> way_of(const TrainModel& model, const TrainPlan& plan, double every_s = 0.2);

}  // namespace stepwright::ltl
