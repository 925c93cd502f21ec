#pragma once

// Predicates that somebody outside judges and changes: geometry, a simulation. The planner plans without
// them, as if the outside agreed to everything; whoever knows the outside judges the plan, says with which
// beginnings it cannot go on, and has the task planned again without these.
//
//   auto split = split_outside(task, {"can-move-pick", "is-picked"});
//   model::Outcome skeleton = solve(split->task, {.first_only = true});
//   const Task next = without_beginnings(split->task, {{"pick", 2}}, {{{first_action}}});
//
// Thread rule: pure functions; tasks are immutable.

#include <map>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

// An atom of an outside predicate, over the parameters of an action.
struct OutsideAtom {
  struct Argument {
    int parameter = -1;  // or -1, and then
    std::string object;
  };
  std::string predicate;
  std::vector<Argument> arguments;

  std::vector<std::string> of(const model::GroundAction& action) const;
};

struct OutsideTask {
  Task task;  // conditions on outside predicates are left out, effects on them as well
  // Of each action by its name, in the order of the text.
  std::map<std::string, std::vector<OutsideAtom>> conditions, effects;
  // Of each outside predicate that the domain declares: the names that each of its parameters may have.
  std::map<std::string, std::vector<std::vector<std::string>>> objects;
};

// Fails with P0119 where an outside predicate is negated, or stands elsewhere than in the outermost
// conjunction of a precondition or an effect.
[[nodiscard]] result::Result<OutsideTask> split_outside(const Task& task,
                                                        const std::vector<std::string>& predicates);

// Actions that count for beginnings, by name, and the parameter that says which object one is about; -1:
// none.
using CountedActions = std::map<std::string, int>;

// What no plan is to begin with: these actions, of all that count; or, with `about`, of those that count and
// are about this object.
struct Beginning {
  std::vector<model::GroundAction> actions;
  std::string about = {};
};

// The same task with only those plans that begin with none of these. Requires actions and objects of the
// task, and beginnings of one action at least. New predicates say how much of which beginning a plan has.
[[nodiscard]] Task without_beginnings(const Task& task, const CountedActions& counted,
                                      const std::vector<Beginning>& forbidden);

}  // namespace stepwright::pddl
