#pragma once

// Planning and options of the mission of two arms from a cell's configuration: used by supervisor, check and
// tests alike. Both require that the cell has [tamp].
//
// Functions without state; any thread. Read the files that the table names.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "supervisor/tamp/mission/arms_mission.h"

namespace stepwright::missions {

// What is wrong with the scene, its orders or the domain; G0403, G0408; C0541.
[[nodiscard]] result::Result<tamp::mission::ArmsPlanning> open_arms_planning(
    const config::CellConfig& config);

// G0401 at a request that means nothing.
[[nodiscard]] result::Result<tamp::mission::ArmsMissionOptions> arms_options(
    const config::CellConfig& config, const tamp::mission::ArmsPlanning& planning);

}  // namespace stepwright::missions
