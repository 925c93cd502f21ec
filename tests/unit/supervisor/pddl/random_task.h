#pragma once

// Random small tasks: facts, numbers between 0 and 6, conditional and universal effects, disjunctions, costs
// that may depend on the state.

#include <cstdint>
#include <string>

#include "supervisor/pddl/task.h"

namespace stepwright::pddl::testing {

struct RandomTask {
  std::string domain, problem;
  Task task;
};

// The same seed gives the same task.
RandomTask random_task(std::uint32_t seed);

}  // namespace stepwright::pddl::testing
