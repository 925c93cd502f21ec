#pragma once

// Marks the predicates that are evaluated outside of the symbolic state.
//
// Thread rule: pure function.

#include <string>
#include <vector>

#include "supervisor/htn/task/names.h"
#include "supervisor/htn/task/planning_task.h"
#include "supervisor/lisp/reporter.h"

namespace stepwright::htn {

// Before bodies are resolved. A name that no predicate has is reported at the domain (P0607).
void mark_external(const std::vector<std::string>& external, Place domain, const Names& names,
                   PlanningTask& task, lisp::Reporter& reporter);

}  // namespace stepwright::htn
