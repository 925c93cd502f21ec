#pragma once

// A plan as JSON: `plan` (actions in order, as text), `plan_steps`, `plan_cost`, and `tree`: `roots` and
// `nodes`, where each node has its `task` and, unless it is an action, `method`, `binding` and `subtasks`
// (numbers of nodes).
//
// Thread rule: pure function.

#include <nlohmann/json_fwd.hpp>

#include "supervisor/htn/plan/plan.h"

namespace stepwright::htn {

nlohmann::json to_json(const Plan& plan);

}  // namespace stepwright::htn
