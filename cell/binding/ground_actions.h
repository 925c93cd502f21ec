#pragma once

// Every ground action of a planning task whose static conditions hold: what may be asked of a binding.
//
//   for (const pddl::GroundActionInfo& info : ground_actions(task, 10'000).actions) ...
//
// Pure functions.

#include <cstddef>
#include <string>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::cell_binding {

struct GroundActions {
  std::vector<pddl::GroundActionInfo> actions;  // in the order of the domain, then of its objects
  bool complete = true;                         // false: there are more than `most` combinations
};

// Combinations of objects that fit the parameters, `most` of them at most, without those that the facts and
// numbers that nothing changes exclude.
GroundActions ground_actions(const pddl::Task& task, std::size_t most);

// "(and (is-at v1 f1) (<= (+ (lev v1) 2) 10))": what the action needs, as a goal.
std::string precondition_text(const pddl::GroundActionInfo& info);

}  // namespace stepwright::cell_binding
