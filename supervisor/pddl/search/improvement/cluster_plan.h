#pragma once

// Another order of a plan's operators, in which those that work towards each other stand close together.
//
// Thread rule: pure function.

#include <vector>

#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

// The plan itself if there are derived facts, or if the other order turns out not to be executable.
std::vector<int> cluster_plan(const StateSpace& space, const std::vector<int>& plan);

}  // namespace stepwright::pddl
