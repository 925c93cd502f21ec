#pragma once

// A plan of arms as the record of a run has it: its actions with their times, before any of it is driven.
//
// A pure function; any thread.

#include "supervisor/run/run_record.h"
#include "supervisor/tamp/mission/arms_planning.h"

namespace stepwright::tamp::mission {

// Without digest, origin and begin. An action without a motion of its own is done. The cost is the time, s.
run::Episode episode_of(const PreparedArms& prepared);

}  // namespace stepwright::tamp::mission
