#pragma once

// Better plans while time is left: what a plan can do without goes first, then what its neighbourhood and its
// windows offer, then weighted A* with falling weights, each started anew with the better bound (Richter,
// Thayer, Ruml 2010, "The joy of forgetting: faster anytime search via restarting").
//
// Thread rule: one call, one object.

#include <memory>

#include "supervisor/pddl/search/engines/lazy_search.h"
#include "supervisor/pddl/search/improvement/plan_windows.h"

namespace stepwright::pddl {

class Improvement {
 public:
  Improvement(const RelaxedTask& task, SearchControl& control, const LowerBounds& bounds,
              const Landmarks& landmarks);

  // Requires a plan. Expands about so many states. Exhausted: the control's best plan is proved the best.
  SearchStatus run(std::uint64_t expansions, StopReason& reason);

 private:
  SearchStatus polish(std::uint64_t expansions, StopReason& reason);
  SearchStatus search(std::uint64_t expansions, StopReason& reason);
  void next_stage();

  const RelaxedTask& task_;
  SearchControl& control_;
  const LowerBounds& bounds_;
  const Landmarks& landmarks_;
  std::unique_ptr<LazySearch> weighted_;
  std::size_t stage_ = 0;
  std::uint64_t polished_ = 0;   // version of the plan that was polished last
  std::uint64_t effort_ = 2000;  // of one polish, in states
  PlanWindows windows_;
};

}  // namespace stepwright::pddl
