#pragma once

// Plans a task in PDDL together with motions: the planner of supervisor/pddl proposes a plan of actions as if
// geometry agreed to all of it (a skeleton); intervals and the sequence solver judge it; what they refuse
// becomes a beginning that no plan may have, and the next skeleton is asked for. What intervals refute about
// one thing is forbidden whatever happens to the others in between, and an action that they refute by itself
// is left out of the task.
//
// The domain has the same geometric predicates as one in HDDL (predicates/grounding.h). Only beginnings that
// were proved to be impossible stay forbidden: the others are tried again with more effort until something is
// used up, so that "no plan exists" is a proof.
//
// A function without state; any thread, one thread each. The same seed gives the same plan, or none for the
// same reason, unless the deadline ends it (TampOutcome::by_clock).
//
//   auto task = read_skeletons(domain, problem);
//   const TampOutcome outcome = plan(cell, *task, model, {.seed = 1});

#include "runtime/ground/result/result.h"
#include "supervisor/pddl/task/outside.h"
#include "supervisor/tamp/planner/interval_model.h"
#include "supervisor/tamp/planner/tamp_planner.h"

namespace stepwright::tamp::planner {

// Fails as pddl::parse_task and pddl::split_outside do.
[[nodiscard]] result::Result<pddl::OutsideTask> read_skeletons(const pddl::Source& domain,
                                                               const pddl::Source& problem);

// Method::Ours only.
TampOutcome plan(const scene::RobotCell& cell, const pddl::OutsideTask& task, const IntervalModel& model,
                 const TampOptions& options);

}  // namespace stepwright::tamp::planner
