#pragma once

// Plans as text, in the format of VAL: actions in parentheses, mostly one per line, `;` comments, an optional
// `12:` or `0.00:` before and `[1]` after each; names in any case. Time stamps order the actions; those of
// the same time stay as they stand.
//
// Thread rule: pure functions.

#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

struct PlanText {
  std::string file;
  std::vector<model::GroundAction> actions;
  std::vector<std::uint32_t> lines;  // the line of each action, from 1
};

// Fails (P04xx) with every malformed line.
[[nodiscard]] result::Result<PlanText> parse_plan(const Source& source);

// The text that parse_plan reads back; the cost stands in a comment.
std::string print_plan(const model::Plan& plan);

}  // namespace stepwright::pddl
