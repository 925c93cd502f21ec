#pragma once

// Better plans near a known one: all states within a growing distance of its states, and the cheapest way
// through them (Nakhost, Mueller 2010, plan neighbourhood graph search). Needs no estimate, so it works the
// same for numbers, conditional effects and costs that depend on the state.
//
// Thread rule: one call, one object.

#include <cstdint>
#include <vector>

#include "supervisor/pddl/search/bounds/lower_bounds.h"
#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/space/state_table.h"

namespace stepwright::pddl {

class PlanNeighbourhood {
 public:
  PlanNeighbourhood(const StateSpace& space, SearchControl& control, const LowerBounds& bounds);

  // Expands at most so many states around the plan; better plans are offered to the control. False if the
  // control says stop.
  bool search(const std::vector<int>& plan, std::uint64_t expansions, StopReason& reason);

 private:
  struct Entry {
    std::uint32_t distance;  // from the plan
    double cost;             // of the way to the node: the cheapest first, so that few are expanded again
    std::uint32_t node;
    bool operator>(const Entry& other) const {
      if (distance != other.distance) return distance > other.distance;
      return cost != other.cost ? cost > other.cost : node > other.node;
    }
  };

  void follow(const std::vector<int>& plan);
  void push(std::uint32_t node, std::uint32_t distance);
  void expand(std::uint32_t node, std::uint32_t distance);
  void successor(std::uint32_t parent, std::uint32_t distance, int op, double cost);
  bool worth(std::uint32_t node, const Word* state);
  void offer_goal(std::uint32_t node, const Word* state);

  const StateSpace& space_;
  SearchControl& control_;
  const LowerBounds& bounds_;
  BestKnown best_;
  MemoryShare memory_;
  StateTable nodes_;
  std::vector<Entry> open_;
  std::vector<Word> state_, next_;
  std::vector<int> applicable_;
  double least_potential_;
};

}  // namespace stepwright::pddl
