#pragma once

// A picture of a plan on its floor: obstacles, places with their names, what the links sweep, the way of the
// car's reference point with its start, and where the task's letters change along it. It has a size of its
// own, and colours for light and dark pages.
//
// Thread rule: pure function. Example:
//   write(plan_svg(*problem, answer->plan));

#include <string>

#include "supervisor/ltl/scene/scene.h"
#include "supervisor/ltl/train/train_plan.h"

namespace stepwright::ltl {

std::string plan_svg(const Problem& problem, const TrainPlan& plan);

}  // namespace stepwright::ltl
