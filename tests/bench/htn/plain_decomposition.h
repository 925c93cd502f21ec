#pragma once

// The baseline: decomposition as the paper on SHOP2 prints it, for totally ordered networks without external
// predicates. Preconditions are matched with the state's facts from the left to the right; nothing is
// remembered, so that what recursion leads round in a circle ends at 1500 steps only.

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/htn/task/planning_task.h"

namespace stepwright::bench {

struct PlainAnswer {
  bool solved = false;
  std::vector<std::string> steps;  // "(drive t l0 l1)"
  std::uint64_t decompositions = 0;
};

PlainAnswer decompose_plainly(const htn::PlanningTask& task, std::chrono::steady_clock::time_point until);

}  // namespace stepwright::bench
