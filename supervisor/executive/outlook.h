#pragma once

// Outlook: where a plan that is made at this moment for another goal would begin. It is what is known of the
// plant, what is wanted of it, and what is left of the plan that runs. A copy for whoever is not the thread
// of the run.
//
// Plain values.

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "supervisor/model/plan.h"
#include "supervisor/model/planned_run.h"

namespace stepwright::executive {

struct Outlook {
  model::NamedState state;                     // in multiples that a planner counts in
  bool ahead = false;                          // the actions that run are taken for ended
  std::string goal;                            // PDDL; empty: the problem's
  std::vector<model::GroundAction> remaining;  // of the plan that runs, from `state` on; empty: none runs
  std::set<std::string> without;               // devices of the binding that count as failed
  std::uint64_t revision = 0;                  // another one with every change
};

}  // namespace stepwright::executive
