#pragma once

// The monitors of a cell that its mission is told of (cell/monitors). Thread-safe: pure but for the files of
// formulas.
//
//   mission->watch(missions::watched_tags(config));

#include <vector>

#include "cell/config/cell_config.h"
#include "supervisor/run/tag_watch.h"

namespace stepwright::missions {

// With what is said of each when it fails. None where the monitors are wrong, which who opens the planner is
// told.
std::vector<run::WatchedTag> watched_tags(const config::CellConfig& config);

}  // namespace stepwright::missions
