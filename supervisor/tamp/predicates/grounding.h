#pragma once

// Grounding of a task's names in a cell: the predicates can-move-pick (arm, grasp, thing), can-move-place
// (arm, place, thing), can-move-away (arm, thing) and their effects is-picked, is-placed, is-away. A place is
// a region or a thing that carries others.
//
// Does not change after it was made; any thread. The task and the cell outlive it.

#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/htn/plan/plan.h"
#include "supervisor/htn/search/semantic_attachment.h"
#include "supervisor/htn/task/planning_task.h"
#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::predicates {

// For read_task().
const std::vector<std::string>& geometric_predicates();

// What an atom with these names asks for or does; nothing if the cell does not have one of them.
std::optional<scene::ActionSpec> action_of(const scene::RobotCell& cell, const std::string& predicate,
                                           const std::vector<std::string>& names);

class Grounding {
 public:
  Grounding(const htn::PlanningTask& task, const scene::RobotCell& cell);

  std::optional<scene::ActionSpec> action_of(const htn::ExternalCall& atom) const;
  // Of all actions of a plan that have a geometric effect, in their order; `steps[k]`: which of the plan's.
  std::vector<scene::ActionSpec> actions_of(const htn::Plan& plan, std::vector<std::size_t>& steps) const;

 private:
  const htn::PlanningTask* task_;
  const scene::RobotCell* cell_;
};

}  // namespace stepwright::tamp::predicates
