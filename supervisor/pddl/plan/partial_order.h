#pragma once

// From a sequence to the order that its actions really need. Two actions stay ordered if one reads what the
// other writes, or both write the same fact or fluent; only increases and decreases of fluents that nothing
// but the metric reads commute. Every linearization of the result is therefore a plan with the same end state
// and cost (block-free deordering, Backstrom 1998, "Computational aspects of reordering plans").
//
// Thread rule: pure functions.

#include <functional>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

// The transitively reduced partial order, sorted by (before, after). Fails if the plan names an unknown
// action, or (P0311) if `stop`, which is asked about every thousand steps of work, gives up; the plan need
// not reach the goal.
[[nodiscard]] result::Result<std::vector<model::Ordering>> lift_partial_order(
    const Task& task, const model::Plan& plan, std::function<bool()> stop = {});

}  // namespace stepwright::pddl
