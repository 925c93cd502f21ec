#pragma once

// Takes out of a plan what it can do without: every operator together with those that then cannot be applied
// any more (Nakhost, Mueller 2010, "Action elimination and plan neighborhood graph search").
//
// Thread rule: pure function.

#include <vector>

#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

// The plan without what only costs. Stops early, with what it has, when the control says so.
std::vector<int> eliminate_actions(const StateSpace& space, std::vector<int> plan, SearchControl& control);

}  // namespace stepwright::pddl
