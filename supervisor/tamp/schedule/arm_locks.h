#pragma once

// Locks between the motions of two arms: which part of whose path has to wait until the other arm has come
// how far.
//
// Paths are cut into pieces. Two pieces of different arms are locked unless it is shown that the capsules
// around the arms and what they hold stay apart, wherever within its piece each of them is: a capsule moves
// by no more than what its joints turn, times its distance from their axes. Of two locked pieces that of the
// action that is later in the plan waits. So where an arm rests needs no lock of its own: it is the end of
// the piece before and the begin of the next one. Detail of this folder; a function without state.

#include "supervisor/tamp/schedule/arm_capsules.h"
#include "supervisor/tamp/schedule/arm_schedule.h"

namespace stepwright::tamp::schedule {

struct LockOptions {
  double apart_m = 0.08;
  double piece_rad = 0.08;
};

// What an arm's capsules are in each of its steps, what it holds among them.
using StepCapsules = std::vector<std::vector<ArmCapsules>>;  // by arm and step

// Fills in the waits of all steps. Requires steps with their motions.
void lock_arms(CellSchedule& schedule, const StepCapsules& capsules, const LockOptions& options);

}  // namespace stepwright::tamp::schedule
