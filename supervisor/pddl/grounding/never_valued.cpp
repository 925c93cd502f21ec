#include "supervisor/pddl/grounding/never_valued.h"

#include "supervisor/pddl/lifted/lifted_state.h"

namespace stepwright::pddl {

std::string never_valued(const GroundTask& task) {
  constexpr std::size_t kTold = 3;
  std::vector<bool> changed(task.variables.size(), false);
  for (const GroundOperator& op : task.operators) {
    for (const GroundEffect& effect : op.effects) {
      for (const NumericEffect& change : effect.numeric)
        changed[static_cast<std::size_t>(change.variable)] = true;
    }
  }
  std::string names;
  std::size_t found = 0;
  for (std::size_t v = 0; v < task.variables.size(); ++v) {
    if (!changed[v] || !task.bounds[v].empty() || ++found > kTold) continue;
    names += (names.empty() ? "" : ", ") + fluent_name(*task.definition, task.variables[v]);
  }
  if (found > kTold) names += " and " + std::to_string(found - kTold) + " more";
  if (found == 0) return {};
  return names + (found == 1 ? " never gets a value, so that no action can change it"
                             : " never get a value, so that no action can change them");
}

}  // namespace stepwright::pddl
