#pragma once

// A plan made from numbers of operator applications: a linear program says how often each operator is applied
// at least, which is executed as far as it can be, and from there it is asked again (Davies, Pearce, Stuckey,
// Lipovetzky 2015, "Sequencing operator counts"). Where numbers depend on each other in long chains, this
// sees the whole where estimates that add up their parts see plateaus.
//
// Only the way is kept, not the states on it: in a task of thousands of numbers a plan of millions of steps
// takes some megabytes.
//
// Thread rule: one call, one object. `run` can be resumed after Running.

#include <optional>
#include <vector>

#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/engines/lookahead.h"
#include "supervisor/pddl/search/lp/lp_counting.h"

namespace stepwright::pddl {

class CountingWalk {
 public:
  CountingWalk(const RelaxedTask& task, SearchControl& control);

  // Solves about so many programs. Found: a plan was offered to the control and was better. Exhausted: the
  // walk has ended elsewhere, which proves nothing. Stopped: see `reason`.
  SearchStatus run(std::uint64_t programs, StopReason& reason);

 private:
  bool count();
  bool step();

  const RelaxedTask& task_;
  const StateSpace& space_;
  SearchControl& control_;
  std::optional<LpProgram> program_;  // none: not built yet
  std::optional<CountingRows> rows_;
  Lookahead lookahead_;
  std::vector<AdditiveHeuristic::Use> uses_;
  std::vector<Word> state_, before_;
  std::vector<int> plan_;  // the way to the state
  bool found_ = false;
};

}  // namespace stepwright::pddl
