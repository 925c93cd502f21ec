#pragma once

// From the first plan to the proved optimum: a search that improves plans, searches for others, and A* that
// proves, in turns on one thread or side by side on two. All prune by the best plan that any has found.
//
// On one thread the turns are counted in states, so that the same task gives the same plan. On two, only the
// result's kind and the proved cost are the same every time.
//
// Thread rule: one call, one object.

#include "supervisor/pddl/search/improvement/improvement.h"
#include "supervisor/pddl/search/portfolio/fresh_starts.h"
#include "supervisor/pddl/search/portfolio/proof.h"

namespace stepwright::pddl {

struct PortfolioOptions {
  bool prove_first = false;  // go for the proof, improve little before it
  unsigned threads = 1;      // 1 or 2
};

class Portfolio {
 public:
  // Requires a plan in the control.
  Portfolio(const RelaxedTask& task, SearchControl& control, const PortfolioOptions& options);

  // True if the control's best plan is proved optimal; else see `reason`.
  bool run(StopReason& reason);

  // The cost can fall for ever: there is no optimum.
  bool unbounded() const { return unbounded_; }

 private:
  bool take_turns(StopReason& reason);
  SearchStatus prove_for(Proof& proof, std::uint64_t evaluations, StopReason& reason);
  SearchStatus prove_and_start(Proof& proof, const Landmarks& landmarks, StopReason& reason);
  bool side_by_side(StopReason& reason);
  bool room_for_starts() const;

  const RelaxedTask& task_;
  const StateSpace& space_;
  SearchControl& control_;
  PortfolioOptions options_;
  LowerBounds bounds_;
  bool falling_costs_ = false;  // an operator's cost may be negative
  bool unbounded_ = false;
};

}  // namespace stepwright::pddl
