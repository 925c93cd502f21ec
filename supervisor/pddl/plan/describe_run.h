#pragma once

// A plan in the neutral words of supervisor/model: what translation and executive need to know of PDDL.
//
// Thread rule: pure functions.
//
//   auto run = describe_run(task, plan);
//   translate::translate(*run, binding, options);

#include "runtime/ground/result/result.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

model::NamedState to_named(const State& state);
State from_named(const model::NamedState& state);

// The plan's actions with their ground preconditions and the states around them, from the task's initial
// state; the orderings are the plan's. Fails (P03xx) at the first action that is unknown or not applicable.
[[nodiscard]] result::Result<model::PlannedRun> describe_run(const Task& task, const model::Plan& plan);

}  // namespace stepwright::pddl
