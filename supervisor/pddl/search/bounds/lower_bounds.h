#pragma once

// Admissible bounds for A*: sums over projections in which every operator's cost counts in one projection
// only (zero-one cost partitioning), the maximum over several such sums. Costs and numbers of steps have
// partitions of their own.
//
// Thread rule: one search, one object.

#include <vector>

#include "supervisor/pddl/search/bounds/projection.h"

namespace stepwright::pddl {

struct LowerBound {
  double cost = 0.0;  // kInfinity: no plan from here
  std::uint32_t steps = 0;
};

class LowerBounds {
 public:
  // `stop`: gives up building more; what is there is sound.
  LowerBounds(const StateSpace& space, const std::function<bool()>& stop);

  LowerBound operator()(const Word* state) const;

 private:
  // Distances in one projection under one share of the costs.
  struct Table {
    std::size_t projection;
    std::vector<double> distance;
  };
  using Sum = std::vector<Table>;

  void grow_patterns(const Pattern& seed);
  void keep(Projection projection);
  void add_sums(bool steps, std::vector<Sum>& sums) const;
  Pattern causes(const Pattern& pattern, const Projection& projection) const;
  Sum partition(const std::vector<std::size_t>& order, bool steps) const;
  double evaluate(const Sum& sum, const std::vector<std::uint32_t>& places) const;

  const StateSpace& space_;
  std::vector<Projection> projections_;
  std::vector<Sum> cost_sums_, step_sums_;
  std::size_t most_work_ = 0;  // of one projection, in operator checks
  mutable std::vector<std::uint32_t> places_;
};

}  // namespace stepwright::pddl
