#pragma once

// Search models from vehicles and sections. Pure functions.

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/network/network.h"
#include "supervisor/fleet/schedule/internal/search_model.h"
#include "supervisor/fleet/schedule/motion.h"
#include "supervisor/fleet/schedule/problem.h"
#include "supervisor/fleet/schedule/sections.h"

namespace stepwright::fleet::internal {

// `kept`: by label, which constraints of the motion take part; `chosen`: which sections do, in this order.
SearchModel make_model(const Motion& motion, const Sections& sections, Mode mode,
                       const std::vector<char>& kept, std::span<const std::uint32_t> chosen);

SearchObjective make_objective(const Motion& motion, const ScheduleOptions& options);

// Whether both polygons are occupied at once in the earliest times.
bool overlap_in_time(const Motion& motion, const Network& network, const SpatialPair& pair);

}  // namespace stepwright::fleet::internal
