#pragma once

// Schedule of a plan, when each action should run: the makespan schedule of its partial order on a simple
// temporal network (stn.h), with durations from the binding. Actions that exclude each other at their outputs
// run one after the other; which of them comes first is chosen for the shortest makespan (`makespan_order`).
//
// Pure functions; use from any thread.
//
//   auto made = schedule(run, binding, false);
//   made->actions[3].slack_s()      // how much later it may start and nothing ends later
//   made->links                     // and why one waits for another

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate {

struct ScheduledAction {
  double start_s = 0.0;   // earliest
  double finish_s = 0.0;  // rest included
  double latest_start_s = 0.0;
  double latest_finish_s = 0.0;

  double slack_s() const { return latest_start_s - start_s; }
  // Whatever delays it delays the end.
  bool critical() const { return slack_s() < 1e-6; }
};

enum class LinkKind : std::uint8_t {
  Causal,    // the first brings about or changes what the second needs
  Threat,    // the second changes what the first needs or changes
  Resource,  // outputs that both drive, or that exclude each other
  Listed,    // nothing but the order of the list (a strict sequence)
};

// Why an action waits for another, directly.
struct ScheduleLink {
  std::size_t before = 0;
  std::size_t after = 0;
  LinkKind kind = LinkKind::Causal;
  std::vector<std::string> what;  // facts and fluents, or outputs
};

struct Schedule {
  std::vector<ScheduledAction> actions;  // as in the plan; 0 = the chart's start
  std::vector<ScheduleLink> links;       // transitively reduced, by (before, after)
  double makespan_s = 0.0;               // until DONE, settling included
};

const char* to_string(LinkKind kind);

// Seconds that the binding allows for an action as planned, its rest included. Requires an entry for it;
// T0003 if the plan's states lack what its duration counts.
[[nodiscard]] result::Result<double> nominal_duration(const model::PlannedAction& planned,
                                                      const Binding& binding);

// In the order of the plan's list where outputs exclude each other. Fails with T0001 to T0003 as `translate`.
[[nodiscard]] result::Result<Schedule> schedule(const model::PlannedRun& run, const Binding& binding,
                                                bool sequential);

// The same without a binding: every action takes one unit of time, and there are no outputs to share.
Schedule unit_schedule(const model::PlannedRun& run);

// The order of the list that makes the schedule shortest: element n is the action that should stand at place
// n. It respects the plan's orderings, and is the list itself unless another order is shorter. Optimal within
// a limit of work, which decides some dozen pairs of actions that exclude each other.
[[nodiscard]] result::Result<std::vector<std::size_t>> makespan_order(const model::PlannedRun& run,
                                                                      const Binding& binding);

}  // namespace stepwright::translate
