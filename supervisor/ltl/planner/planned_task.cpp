#include "supervisor/ltl/planner/planned_task.h"

#include <utility>

#include "supervisor/ltl/guide/task.h"

namespace stepwright::ltl {

namespace {

constexpr const char* kName = "task";  // in place of a file
// Of an automaton; beyond them, which takes less than a second to find out, the progression is quicker.
constexpr std::size_t kMostStates = 2'048;
constexpr std::size_t kMostNodes = 400'000;

}  // namespace

result::Result<PlannedTask> read_planned(const Problem& problem) {
  auto task =
      read_task(problem.task, problem.places(), kName,
                {.most_states = kMostStates, .most_nodes = kMostNodes, .acceptance = Acceptance::Strong});
  if (task) {
    begin_behind(problem.read, task->automaton);
    return PlannedTask{std::move(task->formula), std::move(task->automaton), problem.read};
  }
  auto formula = parse_formula(problem.task, kName, problem.places());
  const bool only_too_large = formula && formula->proposition_count() == problem.places().size() &&
                              !formula->terms.has_release(formula->root);
  if (!only_too_large) return result::forward(task);
  return PlannedTask{*std::move(formula), std::nullopt, problem.read};
}

}  // namespace stepwright::ltl
