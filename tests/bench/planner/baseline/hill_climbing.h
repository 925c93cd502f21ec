#pragma once

// The baseline of the first plan, as a textbook has it (Hoffmann, Nebel 2001; Hoffmann 2003): enforced
// hill-climbing over helpful operators with the relaxed-plan estimate; where that fails, greedy best-first
// search over all operators from the start. It stops at its first plan.
//
// Same grounding and same states as the planner. Thread rule: pure function.

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::bench {

struct BaselineLimits {
  std::chrono::milliseconds time{0};
  std::size_t memory_mb = 0;
};

struct Baseline {
  bool found = false;
  std::vector<model::GroundAction> actions;
  std::uint64_t evaluated = 0;
  bool climbed = false;  // hill-climbing did it
  std::string reason;    // without a plan
};

Baseline hill_climbing(const pddl::Task& task, const BaselineLimits& limits);

}  // namespace stepwright::bench
