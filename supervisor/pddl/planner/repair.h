#pragma once

// Plan repair: what is left of a plan, mended from the state that was observed, beside a new plan.
//
// The remaining actions are kept as they are if they still lead to the goal (an exact execution on the action
// schemas says so, numbers included). Otherwise a plan is made anew, and the longest suffix is looked for to
// which the other actions of the new plan, in their order, lead up: a repaired plan as good as the new one,
// in cost and then in length, for which nothing has to be searched. What stays of a plan that runs need not
// be thought over by anybody. Only where the new plan is not proved optimal, is missing for want of time, or
// is not wanted (`compare`), a search goes from here to the weakest precondition (regression.h) of each
// suffix, the longest first, and for no longer than the new plan took. No plan leaves without having been
// executed on the schemas.
//
// Deterministic where the new plan is proved optimal: no time decides.
//
// Thread rule: pure function; the callbacks of `Options` are called from the calling thread.
//
//   RepairOutcome mended = repair(*task.with_initial(observed), remaining, {.search = {.optimal = true}});
//   if (mended.kind == RepairKind::Kept) ...   // go on as if nothing had happened

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/planner/solve.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

struct RepairOptions {
  Options search;                               // of the new plan; its `cancel` ends everything
  std::chrono::milliseconds connect_time{150};  // at most, for all the connections together
  std::size_t longest_connection = 16;          // actions in front of the suffix
  bool compare = true;  // false: the first repaired plan is taken, and none is made anew beside it
};

enum class RepairKind : std::uint8_t {
  Kept,       // nothing to repair
  Repaired,   // a connection and a suffix of the old plan
  Replanned,  // a new plan: no suffix could be connected, or none as good
  None,       // no plan; the outcome says why
};

struct RepairOutcome {
  RepairKind kind = RepairKind::None;
  model::Outcome outcome;      // as of solve; a kept or repaired plan has the bound of the new one, if known
  std::size_t kept = 0;        // actions of the old plan that the taken plan ends with (Kept, Repaired)
  std::size_t of = 0;          // remaining actions that were given
  std::size_t connection = 0;  // actions in front of them (Repaired)
  std::size_t searches = 0;    // for connections
  double repair_ms = 0.0;      // for the repaired plan, or to know that there is none; without the new plan
  double replan_ms = 0.0;      // of the new plan; 0 if none was made
  std::optional<double> repaired_cost;   // of the best repaired plan, taken or not
  std::optional<double> replanned_cost;  // of the new plan, taken or not
};

const char* to_string(RepairKind kind);

// `task` starts at the observed state. A `remaining` that names unknown actions is only replanned.
[[nodiscard]] RepairOutcome repair(const Task& task, const std::vector<model::GroundAction>& remaining,
                                   const RepairOptions& options = {});

}  // namespace stepwright::pddl
