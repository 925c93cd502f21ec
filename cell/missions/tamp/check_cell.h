#pragma once

// Check that the simulated cell is that of the problem: the same arms in the same order, the same furniture
// and things. A pure function; any thread.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::missions {

// G0403, at the place of what is another one. Nothing is checked where the plant is not simulated.
[[nodiscard]] result::Result<void> check_agrees(const config::PlantConfig& plant,
                                                const tamp::scene::RobotCell& cell,
                                                const result::Location& problem);

}  // namespace stepwright::missions
