#pragma once

// Words of the commands for an outcome: its name in JSON, and their exit code where nothing else is known of
// it.
//
// Pure functions.

#include "runtime/ground/result/exit_code.h"
#include "supervisor/model/plan.h"

namespace stepwright::model {

// "solved", "approximate", "infeasible", "exhausted", "cancelled".
const char* name_of(OutcomeKind kind);

// Done for a plan within the goal itself, NoPlan where it is proved that there is none, else BudgetExhausted.
result::ExitCode exit_of(OutcomeKind kind);

}  // namespace stepwright::model
