#pragma once

// Cost of an action that starts in a given state: how much it adds to a quantity. With the planned state it
// is the planned cost, with the measured one the actual cost (the paper's Figures 15 and 16). A pure
// function; any thread.

#include <string>

#include "supervisor/model/planned_run.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::executive {

// `fluent` names the quantity, "(transport-cost)"; empty means the task's metric (1 per action without one).
// Preconditions are not checked, since a measured state meets none of them exactly. 0 if the action or a
// value is unknown.
double action_cost(const pddl::Task& task, const std::string& fluent, const model::GroundAction& action,
                   const model::NamedState& before);

}  // namespace stepwright::executive
