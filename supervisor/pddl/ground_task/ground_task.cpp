#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

model::GroundAction action_of(const GroundTask& task, const GroundOperator& op) {
  model::GroundAction action;
  action.name = task.definition->actions[static_cast<std::size_t>(op.action)].name;
  for (const int object : op.arguments) {
    action.arguments.push_back(task.definition->objects[static_cast<std::size_t>(object)].name);
  }
  return action;
}

}  // namespace stepwright::pddl
