#pragma once

// The planner: a first plan quickly, then better ones until the budget ends or the optimum is proved.
//
// First plan: lazy greedy search with relaxed plans and landmarks, which follows relaxed plans as far as they
// can be executed. Improvement: what a plan can do without, its neighbourhood, weighted A*. Proof: A* in the
// lexicographic order (metric, number of actions) with admissible bounds; the value of the metric is
// evaluated exactly between states, so costs may depend on the state.
//
// Deterministic on one thread: the same task gives the same plan, unless a budget ends the search. On two,
// one proves while the other improves: only the outcome's kind and a proved optimum are the same every time.
//
// Thread rule: `solve` keeps no state. `on_progress` is called from the calling thread, `on_improvement` from
// the one that found the plan, one call at a time.
//
//   model::Outcome outcome = solve(task, {.optimal = true, .budget = {.time = 5s}});

#include <atomic>
#include <chrono>
#include <functional>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

struct Progress {
  double wall_ms = 0.0;
  std::uint64_t expanded = 0;
  double peak_mb = 0.0;
  const model::Plan* best = nullptr;  // valid during the call only
  double bound = 0.0;                 // no plan can cost less (more, if the metric is maximized)
};

struct Options {
  bool optimal =
      false;  // go for the proof directly; without it the search improves plans first and proves last
  bool first_only = false;  // stop at the first plan
  unsigned threads = 1;     // 1: deterministic; 2: a portfolio
  model::Budget budget;     // zero = no limit; memory: 4096 MB, of all that the process grows by
  std::function<void(const model::Plan&)> on_improvement;  // every better plan, orderings not filled
  std::function<void(const Progress&)> on_progress;        // about once a second
  const std::atomic<bool>* cancel = nullptr;               // not owned; set from any thread
  // Actions that no plan may have, because what would execute them has failed. Called from the calling
  // thread.
  std::function<bool(const model::GroundAction&)> excluded{};
};

// Solves the task. Outcome::kind: Solved when the plan is proved optimal (or the first one with
// `first_only`); Infeasible only when proved, with the reason; Exhausted when the budget ended first, with
// the best plan so far; Cancelled likewise. Plan::cost is the value of the metric after the plan (the number
// of actions without a metric). The plan's orderings are filled by lift_partial_order, unless they take
// longer than the budget.
[[nodiscard]] model::Outcome solve(const Task& task, const Options& options = {});

}  // namespace stepwright::pddl
