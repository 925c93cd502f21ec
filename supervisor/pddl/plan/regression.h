#pragma once

// Goal regression: the weakest condition before a sequence of actions, so that all of them can be executed
// and the task's goal holds after them (Waldinger 1977; for numbers by substitution, as in Hoare's assignment
// rule).
//
// Conditional effects are regressed into the cases of their conditions; linear comparisons are kept in one
// normal form, so that amounts that cancel out disappear. What an action does to a derived fact is not
// followed: whoever uses the result executes the sequence once more.
//
// Thread rule: pure function.
//
//   auto goals = weakest_preconditions(task, actions);
//   auto connected = solve(*task.with_goal(*(*goals)[2]));   // to the start of the third action

#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

// Element k is the weakest precondition of the actions from k on as a PDDL formula; the last one, after all
// actions, is the goal itself. Nothing where no state meets it or the formula grows too large; every earlier
// one is then nothing, too. Fails (P03xx) if an action is unknown.
[[nodiscard]] result::Result<std::vector<std::optional<std::string>>> weakest_preconditions(
    const Task& task, const std::vector<model::GroundAction>& actions);

}  // namespace stepwright::pddl
