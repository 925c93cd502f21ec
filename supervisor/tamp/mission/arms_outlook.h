#pragma once

// Where a plan that is made at this moment for another order would begin: things where they are believed to
// be, what hands hold put down where the plan has it, arms at home; and what is left of the plan that runs. A
// copy for whoever is not the thread of the run. Plain values.

#include <cstddef>
#include <string>
#include <vector>

#include "supervisor/tamp/mission/sight.h"
#include "supervisor/tamp/scene/geometric_state.h"

namespace stepwright::tamp::mission {

struct ArmsOutlook {
  std::string goal;  // of the order that there is
  scene::GeometricState state{};
  std::vector<Seen> strangers{};  // stand on the table as well
  bool ahead = false;             // the actions that run are taken for ended
  std::size_t steps_left = 0;     // actions of the plan that runs which have not begun; 0: none runs
  double left_s = 0.0;            // until it ends, from the end of those that have
  std::string text{};             // JSON: goal and facts (supervisor/doc/goals.md)
};

}  // namespace stepwright::tamp::mission
