#pragma once

// The first plan. Quick attempts along relaxed plans solve most tasks; for the others searches of different
// kinds take turns, or run side by side on two threads until one of them has found a plan.
//
// On one thread the turns are counted in states, so that the same task gives the same plan.
//
// Thread rule: one call, one object.

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/pddl/search/engines/counting_walk.h"
#include "supervisor/pddl/search/engines/hill_climbing.h"
#include "supervisor/pddl/search/engines/lazy_search.h"
#include "supervisor/pddl/search/engines/width_search.h"

namespace stepwright::pddl {

class FirstPlan {
 public:
  // `threads`: 1 or 2.
  FirstPlan(const RelaxedTask& task, SearchControl& control, unsigned threads)
      : task_(task), control_(control), threads_(threads) {}

  // Found: the control has a plan. Exhausted: there is none. Stopped: see `reason`.
  SearchStatus run(StopReason& reason);

 private:
  // One of the searches.
  struct Contender {
    std::function<SearchStatus(std::uint64_t, StopReason&)> run;
    std::uint64_t share = 1;  // of a turn
    bool first_thread = true;
    bool proves = true;  // its end proves that there is no plan
    bool ended = false;
  };

  template <typename Search>
  void enter(Search& search, std::uint64_t share, bool first_thread, bool proves);
  void prepare();
  bool has_numbers() const { return !task_.space().task().variables.empty(); }
  LazyOptions with_landmarks() const;
  SearchStatus turn(std::span<Contender> contenders, std::uint64_t expansions, StopReason& reason);
  SearchStatus take_turns(StopReason& reason);
  SearchStatus side_by_side(StopReason& reason);

  const RelaxedTask& task_;
  SearchControl& control_;
  unsigned threads_;
  std::optional<Landmarks> landmarks_;
  std::optional<Interchangeable> objects_;  // where some can change places
  std::optional<WidthSearch> width_;
  std::optional<HillClimbing> intervals_, cheap_, broad_;
  std::optional<LazySearch> full_, thrifty_, greedy_;
  std::vector<Contender> contenders_;
};

}  // namespace stepwright::pddl
