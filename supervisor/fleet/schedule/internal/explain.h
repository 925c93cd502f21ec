#pragma once

// A minimal reason for which there is no schedule: QuickXplain (Junker 2004), first over vehicles, then over
// the sections, temporal constraints and slowest motions of those that are left.

#include <span>

#include "supervisor/fleet/schedule/internal/search.h"
#include "supervisor/fleet/schedule/motion.h"
#include "supervisor/fleet/schedule/schedule.h"

namespace stepwright::fleet::internal {

// Requires a problem without a schedule. The limits are those of all its searches together, which met so many
// conflicts; where they end it the reason is not minimal.
Core explain(const Motion& motion, const Sections& sections, std::span<const TemporalConstraint> constraints,
             Mode mode, const SearchLimits& limits, std::uint64_t& conflicts);

}  // namespace stepwright::fleet::internal
