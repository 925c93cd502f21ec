#pragma once

// Random tasks over the whole language: hierarchical and either types, constants, nested quantifiers, every
// connective, conditional effects within quantified ones, linear and other arithmetic, fluents without a
// value, derived predicates, metrics that depend on the state.

#include <cstdint>
#include <string>

namespace stepwright::pddl::testing {

struct TaskText {
  std::string domain;
  std::string problem;
};

// The same task for the same seed.
TaskText feature_task(std::uint32_t seed);

}  // namespace stepwright::pddl::testing
