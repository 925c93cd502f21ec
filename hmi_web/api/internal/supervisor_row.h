#pragma once

// Rows of the route table that ask something of the supervisor: operators', in the audit trail before and
// after, with a reason. Private to hmi_web/api.
//
//   supervisor_row(cell, "/api/plan/hold", "plan.hold", "Brings the plant to rest", {"Hold", {}},
//                  [](const Body&) { return json{{"request", "hold"}}; });
//
// Pure but for what the handlers do.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "hmi_web/api/cell_control.h"
#include "hmi_web/api/route.h"

namespace stepwright::api {

// What a goal is written in.
inline constexpr const char* kGoalText =
    "as the planner of the cell reads it: PDDL, for example (= (level a1) 4); the task of a train as a "
    "formula, for example visit press then visit rack";

// A text of the body, of up to so many bytes.
Field text_field(const char* name, double most, const char* description);

// The answer for `done`, with the values for the audit trail.
Answer accepted(const result::Result<void>& done, std::string target, std::string after);

// A row whose request to the supervisor is made of its body; it gets a field for the reason, too.
Route supervisor_row(CellControl* cell, const char* path, const char* name, const char* summary, Shape shape,
                     const std::function<nlohmann::json(const Body&)>& request);

}  // namespace stepwright::api
