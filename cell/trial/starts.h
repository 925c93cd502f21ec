#pragma once

// States in which each ground action may start: found by planning for its precondition, and along the plan to
// the cell's own goal.
//
//   Starts starts(task, budget);
//   for (const Start& start : starts.of(info)) ...     // empty: no plan leads to one
//
// Threads: one thread.

#include <chrono>
#include <optional>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::trial {

// A state by the actions that lead to it from the initial state.
struct Start {
  std::vector<model::GroundAction> before;
};

class Starts {
 public:
  // `time`: of each search. The task must outlive this.
  Starts(const pddl::Task& task, std::chrono::milliseconds time);

  // The state that the shortest plan found leads to, and the first one along the plan to the goal where that
  // is another one.
  std::vector<Start> of(const pddl::GroundActionInfo& info);

 private:
  bool applies(const std::vector<model::GroundAction>& before, const model::GroundAction& action) const;
  std::optional<Start> along_goal(const model::GroundAction& action) const;

  const pddl::Task& task_;
  std::chrono::milliseconds time_;
  std::vector<model::GroundAction> goal_plan_;  // empty where none was found
};

}  // namespace stepwright::trial
