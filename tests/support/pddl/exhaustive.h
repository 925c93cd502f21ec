#pragma once

// The plainest optimal planner: uniform-cost search over the action schemas through the validator's executor.
// Slow, and without a line in common with the planner's grounding and search: the oracle of the tests.

#include <functional>
#include <optional>

#include "supervisor/pddl/lifted/lifted_state.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl::testing {

struct Optimum {
  double cost = 0.0;
  std::size_t steps = 0;
};

// The least cost and, for it, the least number of steps; nothing if no plan exists. Costs must not fall along
// a plan. `most_states` guards against tasks that are too large: then it throws.
std::optional<Optimum> exhaustive_optimum(const Task& task, std::size_t most_states);

// Visits every state that can be reached, once each; counters of the metric do not tell states apart.
void for_each_reachable_state(const Task& task, std::size_t most_states,
                              const std::function<void(const LiftedState&)>& visit);

}  // namespace stepwright::pddl::testing
