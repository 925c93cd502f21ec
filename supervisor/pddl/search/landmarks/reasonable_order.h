#pragma once

// Reasonable orders of landmarks, in which one had better be reached before another: reached the other way
// round, the other would have to be given up and reached once more (Hoffmann, Porteous, Sebastia 2004,
// "Ordered landmarks in planning"; Richter, Westphal 2010, "The LAMA planner", section 3.3). A block that
// stands on another is put there after the other stands where it belongs.
//
// Thread rule: pure function.

#include <functional>
#include <vector>

#include "supervisor/pddl/search/landmarks/atom_order.h"

namespace stepwright::pddl {

// For every landmark those that had better be reached first. Without circles, the order in which landmarks
// are reached anyway counted too. `landmarks`: their atoms; `wanted_for`: by landmark those that it holds
// just before. `stop`: gives up; what was found until then is right.
std::vector<std::vector<int>> reasonable_order(const RelaxedTask& task, const AtomOrder& order,
                                               const std::vector<int>& landmarks,
                                               const std::vector<std::vector<int>>& wanted_for,
                                               const std::function<bool()>& stop);

}  // namespace stepwright::pddl
