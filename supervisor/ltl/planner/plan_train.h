#pragma once

// From a problem to a plan: floor to regions, task to an automaton (or, where that would be too large, to a
// progression), why it cannot be done if it cannot, the search, and the plan checker, without whose consent
// no plan is returned. Of a plan that the plan checker refuses nothing remains but another try.
//
// Determinism: the same problem and seed have the same plan, on one thread and on two, unless a time was over
// meanwhile; with rounds in place of times on every machine. A time for shorter plans cuts whole rounds.
//
// Pure functions; any thread, several problems at once; with `threads` above 1 one more works along until
// they return. Example:
//   auto answer = plan_train(*problem, {.seed = 7, .most_s = 10.0});
//   if (!answer) print(to_string(answer.error()));
//   else for (const TrainPiece& piece : answer->plan.pieces) ...

#include <atomic>
#include <cstdint>
#include <limits>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/checker/plan_checker.h"
#include "supervisor/ltl/scene/scene.h"
#include "supervisor/ltl/search/train_search.h"

namespace stepwright::ltl {

inline constexpr const char* kStartDoesNotFit = "L0411";
inline constexpr const char* kImpossible = "L0412";
inline constexpr const char* kNoPlan = "L0413";
inline constexpr const char* kAllRefused = "L0414";
inline constexpr const char* kPlanCancelled = "L0415";

struct PlanOptions {
  std::uint64_t seed = 1;
  double most_s = 10.0;                                               // until the first plan, judged
  std::size_t most_rounds = std::numeric_limits<std::size_t>::max();  // of each of two lines of searches
  std::size_t most_tries = 8;  // searches of each, where the plan checker refuses
  double shorten_s = 0.0;      // for a shorter plan afterwards
  std::size_t shorten_rounds = std::numeric_limits<std::size_t>::max();
  SearchGuide guide = SearchGuide::OnTheRegions;
  std::size_t threads = 0;                    // 1 or 2; 0: as many of them as the machine has
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

struct PlanAnswer {
  TrainPlan plan;
  PlanJudgement judgement;  // accepted
  SearchAnswer search;      // that found the first plan
  std::size_t tries = 1;    // searches until the plan checker agreed
  std::size_t threads = 1;  // that worked on it
  bool shortened = false;   // the plan is a shorter one than the first
  std::size_t states = 0;   // of the task's automaton; 0: it was planned step by step
};

// L0201 to L0208: the floor; L0301: the train; L0001 to L0011, L0311, L0312: the task. L0411: the train does
// not fit where it begins; L0412: a point cannot do the task, with the part to blame and what is in the way;
// L0413: no plan in that time, or rounds; L0414: the plan checker refused what was found; L0415: cancelled.
[[nodiscard]] result::Result<PlanAnswer> plan_train(const Problem& problem, const PlanOptions& options = {});

}  // namespace stepwright::ltl
