#pragma once

// The report of `stepwright fleet --json` (supervisor/doc/fleet_problems.md lists its keys).

#include <optional>
#include <string>

#include "supervisor/fleet/mission/plan_fleet.h"

namespace stepwright::fleet {

// Without a problem: envelopes alone were scheduled.
std::string fleet_json(const FleetAnswer& answer, const MissionProblem* problem,
                       std::optional<double> retime_ms);

const char* name_of(Verdict verdict);

}  // namespace stepwright::fleet
