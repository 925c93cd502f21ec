#pragma once

// Order of the operators of a plan: which of them must stay in it, and how those that may move can be brought
// together (Siddiqui, Haslum 2015, "Continuing plan quality optimisation", block deordering). An operator
// stays behind whatever wrote what it reads or writes, and behind whatever read what it writes.
//
// Thread rule: immutable.
//
//   const PlanOrder order(task, plan);
//   const GatheredPlan gathered = order.gather(plan, order.closure({3, 17}));

#include <cstddef>
#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"
#include "supervisor/pddl/search/space/packed_bits.h"

namespace stepwright::pddl {

// For every operator of the plan those that it must come after, by position; ascending is not promised.
std::vector<std::vector<std::size_t>> orderings(const GroundTask& task, const std::vector<int>& plan);

// The operators of a plan in another order; what was to be gathered stands at first .. last - 1.
struct GatheredPlan {
  std::vector<int> plan;
  std::size_t first = 0, last = 0;
};

class PlanOrder {
 public:
  // Derived facts are not followed: requires a task without axioms.
  PlanOrder(const GroundTask& task, const std::vector<int>& plan);

  // Positions that must come directly before or behind, without those that follow from others.
  const std::vector<std::size_t>& neighbours(std::size_t position) const { return neighbours_[position]; }

  // The positions and all that must stay between any two of them, ascending.
  std::vector<std::size_t> closure(const std::vector<std::size_t>& chosen) const;

  // Requires a closure. What need not come behind it comes before it.
  GatheredPlan gather(const std::vector<int>& plan, const std::vector<std::size_t>& closed) const;

 private:
  void connect(std::vector<std::vector<Word>>& sets, std::size_t from, std::size_t to);

  std::size_t words_;
  std::vector<std::vector<std::size_t>> neighbours_;
  std::vector<std::vector<Word>> before_, behind_;  // sets of positions
};

}  // namespace stepwright::pddl
