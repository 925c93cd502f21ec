#pragma once

// Plans that do not come from the best one known: the first plan was the one that was quickest to find, and
// its parts may not lead to a cheap one. Searches that mind costs from the start, or look elsewhere, take
// turns; when they have ended, climbs in random orders of the operators follow one another (Feo, Resende
// 1995, "Greedy randomized adaptive search procedures").
//
// Thread rule: one call, one object; it may be made by one thread and run by another. Turns are counted in
// states and the orders are seeded: the same task takes the same way.
//
//   FreshStarts starts(relaxed, control, landmarks);
//   while (starts.run(1000, reason)) ...   // plans are offered to the control

#include <functional>
#include <memory>
#include <vector>

#include "supervisor/pddl/search/engines/hill_climbing.h"
#include "supervisor/pddl/search/engines/lazy_search.h"
#include "supervisor/pddl/search/engines/width_search.h"

namespace stepwright::pddl {

class FreshStarts {
 public:
  // Requires costs that are not negative. The landmarks must outlive it.
  FreshStarts(const RelaxedTask& task, SearchControl& control, const Landmarks& landmarks);

  // Works through about so many states. False if the control says stop.
  bool run(std::uint64_t states, StopReason& reason);

  // Have the first searches ended?
  bool climbing_at_random() const { return next_ == starts_.size(); }

 private:
  // A search and how many states it may take.
  struct Start {
    std::function<SearchStatus(std::uint64_t, StopReason&)> run;
    std::uint64_t left;
  };

  template <typename Search>
  void add(std::shared_ptr<Search> search, std::uint64_t states);
  std::uint64_t start(std::uint64_t states, StopReason& reason, SearchStatus& status);
  std::uint64_t climb(std::uint64_t evaluations, StopReason& reason, SearchStatus& status);

  const RelaxedTask& task_;
  SearchControl& control_;
  std::vector<Start> starts_;
  std::size_t next_ = 0;
  std::unique_ptr<HillClimbing> climb_;
  std::uint32_t climbs_ = 0, turn_ = 0;
  std::uint64_t longest_climb_;  // evaluations that one may take
};

}  // namespace stepwright::pddl
