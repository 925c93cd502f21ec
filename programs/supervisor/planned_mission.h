#pragma once

// The cell of a PDDL problem ([planning]).
//
// Threads: as CellMission.

#include "programs/supervisor/cell_mission.h"

namespace stepwright::supervisor_program {

bool has_planning(const config::CellConfig& config);
[[nodiscard]] result::Result<std::unique_ptr<CellMission>> open_planned_mission(
    const config::CellConfig& config);

}  // namespace stepwright::supervisor_program
