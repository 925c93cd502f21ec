#pragma once

// The vehicles of a problem file and their models.

#include "supervisor/fleet/mission/internal/names.h"

namespace stepwright::fleet::internal {

geometry::Pose read_pose(const JsonItem& item);

// `models` and `vehicles`. Routes are read later, when goals are known.
void read_vehicles(const JsonItem& root, MissionProblem& problem, Names& names, JsonComplaints& complaints);

}  // namespace stepwright::fleet::internal
