#pragma once

// Better plans while time is left: what a plan can do without goes first, then what its neighbourhood and its
// windows offer, then weighted A* with falling weights, each started anew with the better bound (Richter,
// Thayer, Ruml 2010, "The joy of forgetting: faster anytime search via restarting").
//
// Thread rule: one call, one object.

#include <functional>
#include <memory>
#include <vector>

#include "supervisor/pddl/search/hill_climbing.h"
#include "supervisor/pddl/search/lazy_search.h"
#include "supervisor/pddl/search/plan_windows.h"
#include "supervisor/pddl/search/width_search.h"

namespace stepwright::pddl {

class Improvement {
 public:
  Improvement(const RelaxedTask& task, SearchControl& control, const LowerBounds& bounds,
              const Landmarks& landmarks);

  // Requires a plan. Expands about so many states. Exhausted: the control's best plan is proved the best.
  SearchStatus run(std::uint64_t expansions, StopReason& reason);

 private:
  // A search for a plan of its own.
  struct Start {
    std::function<SearchStatus(std::uint64_t, StopReason&)> run;
    std::uint64_t share;  // of a turn, in proportion to what a state of it takes
    std::uint64_t left;   // states
  };

  template <typename Search>
  void add_start(std::shared_ptr<Search> search, std::uint64_t share, std::uint64_t states);
  SearchStatus start_elsewhere(std::uint64_t states, StopReason& reason);
  SearchStatus polish(std::uint64_t expansions, StopReason& reason);
  SearchStatus search(std::uint64_t expansions, StopReason& reason);
  void next_stage();

  const RelaxedTask& task_;
  SearchControl& control_;
  const LowerBounds& bounds_;
  const Landmarks& landmarks_;
  std::vector<Start> starts_;  // that have not ended
  std::unique_ptr<LazySearch> weighted_;
  std::size_t stage_ = 0;
  std::uint64_t polished_ = 0;   // version of the plan that was polished last
  std::uint64_t effort_ = 2000;  // of one polish, in states
  PlanWindows windows_;
};

}  // namespace stepwright::pddl
