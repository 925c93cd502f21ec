#pragma once

// From the first plan to the proved optimum: weighted searches with falling weights for better plans, and the
// plain A* that proves, in turns of growing length, so that neither waits for the other in vain.
//
// Thread rule: one call, one object.

#include <memory>

#include "supervisor/pddl/search/astar_search.h"

namespace stepwright::pddl {

class Improvement {
 public:
  Improvement(const StateSpace& space, SearchControl& control, const LowerBounds& bounds)
      : space_(space), control_(control), bounds_(bounds), proof_(space, control, bounds, 0.0) {}

  // True if the control's best plan is proved optimal; else see `reason`. `anytime`: with weighted searches
  // in between.
  bool run(bool anytime, StopReason& reason);

  bool unbounded() const { return proof_.unbounded(); }

 private:
  SearchStatus improve(std::uint64_t expansions, StopReason& reason);

  const StateSpace& space_;
  SearchControl& control_;
  const LowerBounds& bounds_;
  AStarSearch proof_;
  std::unique_ptr<AStarSearch> weighted_;
  double weight_ = 5.0;
};

}  // namespace stepwright::pddl
