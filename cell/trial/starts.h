#pragma once

// States in which each ground action may start: found by planning for its precondition, and along the plan to
// the cell's own goal, wherever the action stands in it.
//
//   Starts starts(task, own, time);
//   for (const Start& start : starts.of(info)) ...     // empty: no plan leads to one
//
// Threads: one thread.

#include <chrono>
#include <cstddef>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"
#include "supervisor/pddl/planner/solve.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::trial {

// A state by the actions that lead to it from the initial state.
struct Start {
  std::vector<model::GroundAction> before;
};

class Starts {
 public:
  // `own`: how the cell plans, which gives the plan that it would run. `time`: of each other search. The task
  // must outlive this.
  Starts(const pddl::Task& task, const pddl::Options& own, std::chrono::milliseconds time);

  // The state that the shortest plan found leads to; then each other one in which the cell's plan has the
  // action, or, if it has it nowhere, the first one along that plan in which it applies.
  std::vector<Start> of(const pddl::GroundActionInfo& info);

 private:
  bool applies(const std::vector<model::GroundAction>& before, const model::GroundAction& action) const;
  std::vector<Start> along_goal(const model::GroundAction& action) const;
  Start after(std::size_t actions) const;

  const pddl::Task& task_;
  std::chrono::milliseconds time_;
  std::vector<model::GroundAction> goal_plan_;  // empty where none was found
};

}  // namespace stepwright::trial
