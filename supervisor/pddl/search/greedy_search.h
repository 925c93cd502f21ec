#pragma once

// Greedy best-first search with the relaxed-plan heuristic for the first plan: successors wait under their
// parent's estimate (lazy evaluation), those by helpful operators in a queue of their own that is served more
// often after progress (Richter, Helmert 2009, "Preferred operators and deferred evaluation"). Complete:
// without a plan in a finite space it says so.
//
// Thread rule: one call, one object. Can be resumed.

#include "supervisor/pddl/search/relaxed_plan.h"
#include "supervisor/pddl/search/search_control.h"

namespace stepwright::pddl {

enum class SearchStatus : std::uint8_t { Running, Found, Exhausted, Stopped };

class GreedySearch {
 public:
  GreedySearch(const StateSpace& space, SearchControl& control);

  // Until a plan is found (and offered to the control), the space is exhausted or the control says stop.
  SearchStatus run(StopReason& reason);

  std::size_t memory() const;

 private:
  struct Entry {
    int estimate;
    std::uint64_t order;
    std::uint32_t parent;
    std::int32_t op;
    bool operator>(const Entry& other) const {
      return estimate != other.estimate ? estimate > other.estimate : order > other.order;
    }
  };
  using Queue = std::vector<Entry>;

  void push(Queue& queue, int estimate, std::uint32_t parent, int op);
  bool pop(Entry& entry);
  bool reached(std::uint32_t node);
  void expand(std::uint32_t node);
  std::uint32_t generate(const Entry& entry);

  const StateSpace& space_;
  SearchControl& control_;
  RelaxedPlan heuristic_;
  NodeStore nodes_;
  Queue all_, helpful_;
  std::uint64_t order_ = 0;
  int best_estimate_ = INT32_MAX;
  int all_turns_ = 0, helpful_turns_ = 0;
  std::vector<Word> scratch_;
  std::vector<int> applicable_;
};

}  // namespace stepwright::pddl
