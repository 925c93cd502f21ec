#pragma once

// Check that a task in PDDL is about its cell, as predicates/names.h asks it of one in HDDL.
//
// A function without state; any thread.

#include "runtime/ground/result/result.h"
#include "supervisor/pddl/task/outside.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::planner {

// G0104: an arm or a thing that geometry may be asked about, and which the cell does not have.
[[nodiscard]] result::Result<void> check_names(const pddl::OutsideTask& task, const scene::RobotCell& cell,
                                               const pddl::Source& domain, const pddl::Source& problem);

}  // namespace stepwright::tamp::planner
