#pragma once

// A task as it is planned: with its automaton, or without one where that would be too large. A value; any
// thread.
//
//   auto task = read_planned(problem);
//   TrainSearch search(ground, task->states());   // states are of one thread: each asks for its own

#include <optional>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/automaton.h"
#include "supervisor/ltl/guide/task_states.h"
#include "supervisor/ltl/scene/scene.h"
#include "supervisor/ltl/syntax/formula.h"

namespace stepwright::ltl {

struct PlannedTask {
  Formula formula;
  std::optional<Automaton> automaton;  // begins behind what was read
  std::vector<Letter> read;

  TaskStates states() const { return automaton ? TaskStates(*automaton) : TaskStates(formula, read); }
};

// Acceptance is strong, as the plan checker reads it. Fails with codes of read_task().
[[nodiscard]] result::Result<PlannedTask> read_planned(const Problem& problem);

}  // namespace stepwright::ltl
