#pragma once

// States met on random walks through a task.

#include <random>
#include <vector>

#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl::testing {

// Calls `visit` with every state of a walk of so many steps; starts again at dead ends.
template <typename Visit>
void random_walk(const StateSpace& space, std::uint32_t seed, int steps, const Visit& visit) {
  std::mt19937 random(seed);
  std::vector<Word> state = space.initial(), next(space.words());
  for (int i = 0; i < steps; ++i) {
    visit(state);
    std::vector<int> applicable;
    for (std::size_t op = 0; op < space.task().operators.size(); ++op) {
      if (space.holds(space.task().operators[op].precondition, state.data()))
        applicable.push_back(static_cast<int>(op));
    }
    double cost = 0.0;
    if (applicable.empty() ||
        !space.apply(applicable[random() % applicable.size()], state.data(), next.data(), cost)) {
      state = space.initial();
    } else {
      state.swap(next);
    }
  }
}

}  // namespace stepwright::pddl::testing
