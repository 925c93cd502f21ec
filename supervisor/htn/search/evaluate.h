#pragma once

// Evaluation of conditions in a symbolic state.
//
// Thread rule: as the state.

#include <vector>

#include "supervisor/htn/search/interrupt.h"
#include "supervisor/htn/search/state.h"
#include "supervisor/htn/task/planning_task.h"

namespace stepwright::htn {

// State and task, and when to give up: quantifiers may take longer than anybody waits.
struct Evaluation {
  const PlanningTask& task;
  const State& state;
  Interrupt& interrupt;
};

// The slots that the condition reads must be bound; those of its quantifiers are written. Once interrupted,
// the answer means nothing.
bool holds(const Condition& condition, std::vector<int>& binding, const Evaluation& in);

// Calls `visit` for every choice of objects for the variables, in the order of the objects.
template <typename Visit>
void each_choice(const std::vector<Variable>& variables, std::size_t from, std::vector<int>& binding,
                 const Evaluation& in, const Visit& visit) {
  if (from == variables.size()) return visit();
  const Variable& variable = variables[from];
  for (const int object : in.task.types[static_cast<std::size_t>(variable.type)].objects) {
    if (in.interrupt.poll()) return;
    binding[static_cast<std::size_t>(variable.slot)] = object;
    each_choice(variables, from + 1, binding, in, visit);
  }
}

}  // namespace stepwright::htn
