#pragma once

// The baseline of the proof: uniform-cost search on the same grounded task and the same states, but with no
// estimate of the way that is left and no incumbent to prune by.
//
// Thread rule: pure function.

#include <cstdint>

#include "supervisor/pddl/task/task.h"

namespace stepwright::bench {

struct UniformCost {
  bool found = false;
  double cost = 0.0;
  std::uint32_t steps = 0;
  std::uint64_t expanded = 0;
};

// The least cost and, for it, the least number of steps. Costs must not fall along a plan.
UniformCost uniform_cost(const pddl::Task& task);

}  // namespace stepwright::bench
