#pragma once

// The proof of the optimum: A* with cheap bounds, which is all that small tasks need, and where it takes
// more, begun again with the dearer bound that promises enough along the best plan known: sets of operators,
// or the linear program, which looks for such sets itself. What decides is numbers of states and values of
// bounds, no clock: the same task takes the same way. The root's bound by the linear program is told in any
// case.
//
// Thread rule: one call, one object; it may be made by one thread and run by another.
//
//   Proof proof(relaxed, control, bounds);
//   if (proof.run(UINT64_MAX, reason) == SearchStatus::Exhausted) ...   // the control's best plan is optimal

#include <memory>

#include "supervisor/pddl/search/engines/astar_search.h"

namespace stepwright::pddl {

class Proof {
 public:
  // Requires a plan in the control.
  Proof(const RelaxedTask& task, SearchControl& control, const LowerBounds& bounds);

  // As AStarSearch::run.
  SearchStatus run(std::uint64_t expansions, StopReason& reason);

  // Are its states dear by now?
  bool dear() const { return cut_ != nullptr || lp_ != nullptr; }
  bool unbounded() const { return search_->unbounded(); }
  // Of the simplex method, so far: most of what dear states take.
  std::uint64_t iterations() const { return lp_ ? lp_->iterations() : 0; }

 private:
  // Sums over some states of the best plan.
  struct Promise {
    double cheap = 0.0, cut = 0.0, lp = 0.0;
  };

  void choose();
  void tell_root(LpBound& lp);
  bool promise(LandmarkCut& cut, LpBound* lp, Promise& sum);

  const RelaxedTask& task_;
  const StateSpace& space_;
  SearchControl& control_;
  const LowerBounds bounds_;  // of its own: its scratch belongs to one thread
  std::unique_ptr<LandmarkCut> cut_;
  std::unique_ptr<LpBound> lp_;
  MemoryShare memory_;
  std::unique_ptr<AStarSearch> search_;
  std::uint64_t cheap_left_;  // expansions before dear bounds are looked at
};

}  // namespace stepwright::pddl
