#pragma once

// From the texts of a domain and a problem to a planning task.
//
// Thread rule: pure function.
//
//   auto task = read_task({"domain.hddl", domain}, {"problem.hddl", problem}, {"can-move-pick",
//   "is-picked"});

#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/htn/task/planning_task.h"

namespace stepwright::htn {

// A task, and warnings of accepted input.
struct ReadTask {
  PlanningTask task;
  result::Diagnostics warnings;
};

// `external` names the predicates that are evaluated outside of the symbolic state: they may stand, negated
// or not, in the conjunction of a precondition, an effect or the goal, and nowhere else (P0607). On failure:
// every error found, each with file, line, column and code P0xxx.
[[nodiscard]] result::Result<ReadTask> read_task(const lisp::Source& domain, const lisp::Source& problem,
                                                 const std::vector<std::string>& external = {});

}  // namespace stepwright::htn
