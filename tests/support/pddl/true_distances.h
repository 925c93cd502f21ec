#pragma once

// Every reachable state of a small task with what is really left to pay from it: what bounds and heuristics
// are judged by.

#include <functional>
#include <vector>

#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl::testing {

struct StateDistance {
  std::vector<Word> state;
  double cost = kInfinity;               // least accumulated cost to a goal; kInfinity: no way
  double steps = kInfinity;              // least number of steps to a goal
  double steps_of_cheapest = kInfinity;  // least number among those that cost no more than `cost`
};

// Throws if there are more than `most_states`. Costs must not be negative.
std::vector<StateDistance> true_distances(const StateSpace& space, std::size_t most_states);

}  // namespace stepwright::pddl::testing
