#pragma once

// Output of `stepwright fleet`: vehicles and their stops with times, who waits for whom where; or why there
// is no schedule. Pure; any thread.

#include <string>

#include "supervisor/fleet/mission/plan_fleet.h"

namespace stepwright::fleet {

std::string fleet_text(const FleetAnswer& answer, const std::string& problem);

}  // namespace stepwright::fleet
