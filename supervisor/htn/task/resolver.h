#pragma once

// Resolves names and checks types: from the syntax trees to a planning task.
//
// Thread rule: pure function. Reports every error; the result is meaningful only if the reporter has none.

#include <string>
#include <vector>

#include "supervisor/htn/syntax/syntax_tree.h"
#include "supervisor/htn/task/planning_task.h"
#include "supervisor/lisp/reporter.h"

namespace stepwright::htn {

PlanningTask resolve(const ParsedDomain& domain, const ParsedProblem& problem,
                     const std::vector<std::string>& external, lisp::Reporter& reporter);

}  // namespace stepwright::htn
