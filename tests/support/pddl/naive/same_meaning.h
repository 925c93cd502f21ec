#pragma once

// The differential test of the language: the schemas' executor, the ground task and the naive interpreter
// walk through the same states, and must agree in each on applicability, successors, goal and metric.

#include <cstddef>
#include <string>

namespace stepwright::pddl::testing {

struct Walked {
  std::size_t states = 0;
  std::size_t steps = 0;  // applicable actions
  std::size_t goals = 0;  // states that meet the goal
};

// Breadth-first from the initial state to at most so many states. Reports differences as test failures.
Walked expect_same_meaning(const std::string& domain, const std::string& problem, std::size_t most_states);

}  // namespace stepwright::pddl::testing
