#pragma once

// A plan with its motions as JSON: for each action `action` (text), `arm`, `thing`, `region`, `pose` of the
// thing, and `motions`: `phase`, `half_open_m` of the fingers, `path` as rows of joint values (rad).
//
// A pure function; any thread.

#include <nlohmann/json_fwd.hpp>

#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::drawing {

nlohmann::json plan_json(const scene::RobotCell& cell, const scene::TampPlan& plan);

}  // namespace stepwright::tamp::drawing
