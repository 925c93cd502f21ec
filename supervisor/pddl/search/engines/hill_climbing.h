#pragma once

// Enforced hill-climbing with relaxed plans over intervals: from each state breadth first along helpful
// operators to one that is nearer to the goal, and on from there (Hoffmann, Nebel 2001, "The FF planning
// system"; Hoffmann 2003, "The Metric-FF planning system"). Crosses plateaus between far goals that a
// best-first search drowns in, because it forgets what it has passed; may end in a dead end.
//
// With `costs` the estimate is what an additive relaxed plan costs, and all operators are tried, those that
// are helpful first: what relaxed plans over intervals leave out may be what is cheap.
//
// Thread rule: one call, one object. `run` can be resumed after Running.

#include <optional>
#include <random>
#include <vector>

#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/relaxation/additive_heuristic.h"
#include "supervisor/pddl/search/relaxation/relaxed_plan.h"
#include "supervisor/pddl/search/space/state_table.h"

namespace stepwright::pddl {

struct ClimbingOptions {
  bool costs = false;      // estimates of cost along additive relaxed plans; else steps over intervals
  bool all = false;        // every operator is tried, those that are helpful first
  std::uint32_t seed = 0;  // of the order in which operators are tried; 0: the task's
};

class HillClimbing {
 public:
  HillClimbing(const RelaxedTask& task, SearchControl& control, const ClimbingOptions& options = {});

  // Evaluates about so many states. Found: a plan was offered to the control and was better. Exhausted: no
  // helpful operator leads on, or no better plan came of it, which proves nothing. Stopped: see `reason`.
  SearchStatus run(std::uint64_t evaluations, StopReason& reason);

  std::uint64_t evaluations() const { return evaluations_; }
  bool arrived() const { return arrived_; }  // at a goal, be the plan better or not

 private:
  bool evaluate(const Word* state, int& estimate, std::vector<int>& to_try);
  void helpful_first(const Word* state, std::vector<int>& to_try);
  bool stand(const std::vector<Word>& state, double cost);
  bool worth(double cost, std::uint32_t steps);
  bool expand(std::uint32_t node);
  void commit(std::uint32_t node);

  const StateSpace& space_;
  SearchControl& control_;
  BestKnown best_plan_;
  MemoryShare memory_;
  ClimbingOptions options_;
  std::optional<RelaxedPlan> intervals_;  // one of the two
  std::optional<AdditiveHeuristic> additive_;
  double least_potential_;
  std::vector<int> way_;                  // operators to where it stands
  int best_ = INT32_MAX;                  // estimate there
  StateTable nodes_;                      // met since, breadth first
  std::vector<std::vector<int>> to_try_;  // operators by node
  std::uint32_t next_ = 0;                // node to expand
  std::vector<Word> state_, child_;
  std::vector<int> applicable_;
  std::minstd_rand random_;
  std::vector<std::uint64_t> marked_;  // expansion in which the operator was helpful
  std::uint64_t evaluations_ = 0, expansions_ = 0;
  bool started_ = false, arrived_ = false, found_ = false, ended_ = false;
};

}  // namespace stepwright::pddl
