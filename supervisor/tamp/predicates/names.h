#pragma once

// Check that a task is about its cell: arms, things and places of its objects are those of the cell, and
// where things are at first is where they stand.
//
// A function without state; any thread.

#include "runtime/ground/result/result.h"
#include "supervisor/htn/task/planning_task.h"
#include "supervisor/lisp/place.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::predicates {

// G0104: an object that geometry is asked about, which the cell does not have; a place that nothing is to be
// put on need not be one of the cell's. G0105: a fact of the initial state that says of a thing that it is
// elsewhere than where it stands.
[[nodiscard]] result::Result<void> check_names(const htn::PlanningTask& task, const scene::RobotCell& cell,
                                               const lisp::Source& domain, const lisp::Source& problem);

}  // namespace stepwright::tamp::predicates
