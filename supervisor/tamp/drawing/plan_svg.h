#pragma once

// A cell from above as a picture: furniture, regions, things where they begin (dashed) and where a plan puts
// them, and the ways of the hands' tools. A pure function; any thread.
//
//   write("plan.svg", plan_svg(cell, plan));

#include <string>

#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::drawing {

std::string plan_svg(const scene::RobotCell& cell, const scene::TampPlan& plan);

}  // namespace stepwright::tamp::drawing
