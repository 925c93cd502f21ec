#pragma once

// A first plan, by two lines of searches and plan checkers. The first line begins with the cheapest route,
// driven plainly, the second one by chance; each goes on, by chance, where the plan checker refuses what it
// has found. Both are cut into slices of a few rounds (the very first one is one round, and the second line
// begins behind it), and the plan of the earliest slice is taken; of the same slice that of the first line.
// So it is the same plan on one thread, where the lines take turns, and on two, where whoever has one waits
// until no earlier slice can have another one; only where the time is over meanwhile it does not wait.
//
// Threads: it starts and joins one of its own. Example:
//   const FirstPlan found = first_plan(search_of, {.start = state, ...}, judge, 2);

#include <functional>

#include "supervisor/ltl/checker/plan_checker.h"
#include "supervisor/ltl/planner/deadline.h"
#include "supervisor/ltl/search/train_search.h"

namespace stepwright::ltl {

struct FirstPlan {
  SearchAnswer search;      // of the line that found it, or of the first one
  PlanJudgement judgement;  // accepted, or why the last one was not
  std::size_t tries = 0;    // of that line: searches until the plan checker agreed
  std::size_t line = 0;

  bool found() const { return search.plan.has_value() && judgement.accepted(); }
};

struct FirstPlanOptions {
  TrainState start{};
  std::uint64_t seed = 1;
  std::size_t most_rounds = std::numeric_limits<std::size_t>::max();  // of a search
  std::size_t most_tries = 8;                                         // of a line
  std::size_t threads = 1;
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

// Asked by the thread of a line: a search of its own, and a judgement, which any thread may ask for and which
// may end, refusing, once there is enough.
struct FirstPlanMeans {
  std::function<std::unique_ptr<TrainSearch>()> search;
  std::function<PlanJudgement(const TrainPlan&, const std::atomic<bool>& enough)> judge;
};

FirstPlan first_plan(const FirstPlanMeans& means, const FirstPlanOptions& options, const Deadline& deadline);

}  // namespace stepwright::ltl
