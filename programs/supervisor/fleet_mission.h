#pragma once

// The cell of a fleet ([fleet]).
//
// Threads: as CellMission.

#include "programs/supervisor/cell_mission.h"

namespace stepwright::supervisor_program {

bool has_fleet(const config::CellConfig& config);
[[nodiscard]] result::Result<std::unique_ptr<CellMission>> open_fleet_mission(
    const config::CellConfig& config);

}  // namespace stepwright::supervisor_program
