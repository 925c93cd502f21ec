#pragma once

// Enforced hill-climbing with relaxed plans over intervals: from each state breadth first along helpful
// operators to one that is nearer to the goal, and on from there (Hoffmann, Nebel 2001, "The FF planning
// system"; Hoffmann 2003, "The Metric-FF planning system"). Crosses plateaus between far goals that a
// best-first search drowns in, because it forgets what it has passed; may end in a dead end.
//
// Thread rule: one call, one object. `run` can be resumed after Running.

#include <vector>

#include "supervisor/pddl/search/relaxed_plan.h"
#include "supervisor/pddl/search/search_control.h"
#include "supervisor/pddl/search/state_table.h"

namespace stepwright::pddl {

class HillClimbing {
 public:
  HillClimbing(const StateSpace& space, SearchControl& control);

  // Evaluates about so many states. Found: a plan was offered to the control and was better. Exhausted: no
  // helpful operator leads on, which proves nothing. Stopped: see `reason`.
  SearchStatus run(std::uint64_t evaluations, StopReason& reason);

 private:
  bool evaluate(const Word* state, int& estimate, std::vector<int>& helpful);
  bool stand(const std::vector<Word>& state);
  bool expand(std::uint32_t node);
  void commit(std::uint32_t node);

  const StateSpace& space_;
  SearchControl& control_;
  MemoryShare memory_;
  RelaxedPlan heuristic_;
  std::vector<int> way_;                   // operators to where it stands
  int best_ = INT32_MAX;                   // estimate there
  StateTable nodes_;                       // met since, breadth first
  std::vector<std::vector<int>> helpful_;  // by node
  std::uint32_t next_ = 0;                 // node to expand
  std::vector<Word> state_, child_;
  std::uint64_t evaluations_ = 0;
  bool started_ = false, found_ = false, ended_ = false;
};

}  // namespace stepwright::pddl
