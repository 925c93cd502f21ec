#pragma once

// One grounding in a process of its own, so that its memory can be told and its end does not end the rest.

#include <functional>

#include "supervisor/pddl/ground_task/ground_task.h"
#include "tests/bench/grounding/generators.h"

namespace stepwright::bench::grounding {

struct Limits {
  double seconds = 20.0;
  std::size_t memory_mb = 4096;
};

struct Measured {
  bool done = false;  // within the limits
  double parse_s = 0.0;
  double ground_s = 0.0;
  double peak_mb = 0.0;  // of the whole process, the text and the parsed task included
  std::size_t operators = 0, facts = 0, variables = 0, groups = 0, axioms = 0;
};

using Ground = pddl::GroundTask (*)(const pddl::Definition&, const std::function<bool()>& stop);

Measured measure(const Instance& instance, Ground ground, const Limits& limits);

}  // namespace stepwright::bench::grounding
