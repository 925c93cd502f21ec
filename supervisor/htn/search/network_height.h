#pragma once

// How long a task network may grow while its first task is being done.
//
// Thread rule: pure function.

#include "supervisor/htn/task/planning_task.h"

namespace stepwright::htn {

struct NetworkHeight {
  // Recursion that is not at the end of a method, so that no length is enough for all plans.
  bool growing = false;
  // The most tasks that a network may have; of growing ones, those that the problem lists.
  int most = 1;
};

NetworkHeight network_height(const PlanningTask& task);

}  // namespace stepwright::htn
