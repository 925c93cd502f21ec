#pragma once

// From the speed along a path as a function of place to rows of a time law, with limits that are kept for
// certain. Functions without state; any thread.

#include <vector>

#include "supervisor/motion/timing/internal/speed_optimiser.h"
#include "supervisor/motion/timing/time_law.h"

namespace stepwright::motion::internal {

// A row for each interval: a quintic with the place, speed and acceleration at both of its ends; beside rest
// a constant jerk.
std::vector<TimeRow> profile_rows(const SpeedGrid& grid, const SpeedProfile& profile);

// The fastest rows along pieces `first` to `last` - 1 of a path, from rest to rest, as speed_grid() cuts
// them.
//
// What an interval uses of the limits between the ends where the optimiser looks is known afterwards, as a
// certain bound. Where that is above 1 the interval's limits are lowered by it, and all is optimised again, a
// few times. At last the time of all rows is stretched (or shortened) so that the greatest use is 1.
std::vector<TimeRow> fastest_rows(const BlendedPath& path, std::size_t first, std::size_t last,
                                  const JointLimits& limits);

}  // namespace stepwright::motion::internal
