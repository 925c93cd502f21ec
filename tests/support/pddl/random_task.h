#pragma once

// Random small tasks: facts, numbers between 0 and 6, conditional and universal effects, disjunctions, costs
// that may depend on the state.

#include <cstdint>
#include <string>

#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl::testing {

struct RandomTask {
  std::string domain, problem;
  Task task;
};

// The same seed gives the same task.
RandomTask random_task(std::uint32_t seed);

// The same with more numbers: goals over sums of fluents that take several applications of an action, amounts
// that depend on the state, and a derived predicate in goals and preconditions.
RandomTask random_numeric_task(std::uint32_t seed);

// Trucks that burn fuel and carry parcels along random roads: much that can be done in any order, fluents of
// which more or less is better, and now and then an action or a goal that wants them otherwise.
RandomTask random_transport_task(std::uint32_t seed);

}  // namespace stepwright::pddl::testing
