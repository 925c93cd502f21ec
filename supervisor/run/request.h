#pragma once

// Request of an operator's page to the supervisor. The text comes over Fast DDS from anywhere: whatever it
// is, it is a request or it is refused. Pure; any thread.
//
//   {"request": "abort"}
//   {"request": "hold"}
//   {"request": "resume"}
//   {"request": "change", "fluent": "(demand c1)", "value": 8}
//   {"request": "goal", "goal": "(= (level a1) 4)"}
//   {"request": "start"}                                       or with a "goal"
//   {"request": "what_if", "id": "7f", "goal": "(= (level a1) 4)"}
//   {"request": "cancel_what_if", "id": "7f"}
//
// And of a fleet:
//
//   {"request": "order", "name": "order 44", "from": "rack 1", "to": "outbound A", "amount": 1}
//   {"request": "block", "name": "spill", "corners_m": [[10, 5], [12, 5], [12, 7], [10, 7]]}
//   {"request": "unblock", "name": "spill"}
//   {"request": "return", "vehicle": "truck 2"}

#include <string>
#include <variant>

#include "runtime/result/result.h"
#include "supervisor/fleet/executive/fleet_request.h"

namespace stepwright::supervisor_program {

struct AbortRequest {};
struct HoldRequest {};
struct ResumeRequest {};
struct ChangeRequest {
  std::string fluent;
  double value = 0.0;
};
struct GoalRequest {
  std::string goal;  // PDDL
};
struct StartRequest {
  std::string goal;  // PDDL; empty: the goal that there is
};
struct WhatIfRequest {
  std::string id;    // of whoever asks
  std::string goal;  // PDDL; empty: the goal that there is
};
struct CancelWhatIfRequest {
  std::string id;  // empty: whichever is planned for
};
using OperatorRequest = std::variant<AbortRequest, HoldRequest, ResumeRequest, ChangeRequest, GoalRequest,
                                     StartRequest, WhatIfRequest, CancelWhatIfRequest, fleet::FleetChange>;

// Fails with X0005 for a text that is none of the above.
[[nodiscard]] result::Result<OperatorRequest> parse_operator_request(const std::string& text);

}  // namespace stepwright::supervisor_program
