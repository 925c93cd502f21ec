#pragma once

// What an operator's page asks of the supervisor. The text comes over Fast DDS from anywhere: whatever it is,
// it is a request or it is refused. Pure; any thread.
//
//   {"request": "abort"}
//   {"request": "change", "fluent": "(demand c1)", "value": 8}
//   {"request": "goal", "goal": "(= (level a1) 4)"}

#include <string>
#include <variant>

#include "runtime/result/result.h"

namespace stepwright::supervisor_program {

struct AbortRequest {};
struct ChangeRequest {
  std::string fluent;
  double value = 0.0;
};
struct GoalRequest {
  std::string goal;  // PDDL
};
using OperatorRequest = std::variant<AbortRequest, ChangeRequest, GoalRequest>;

// Fails with X0005 for a text that is none of the above.
[[nodiscard]] result::Result<OperatorRequest> parse_operator_request(const std::string& text);

}  // namespace stepwright::supervisor_program
