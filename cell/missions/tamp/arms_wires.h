#pragma once

// The terminals of a robot cell in the process image: as [plant.ports] says, or in a row, of which the
// simulated cell says how long it is.
//
// A pure function; any thread.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "supervisor/tamp/program/cell_terminals.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::missions {

// C0541: [plant.ports] lacks a terminal.
[[nodiscard]] result::Result<tamp::program::CellTerminals> terminals_of(const config::CellConfig& config,
                                                                        const tamp::scene::RobotCell& cell);

}  // namespace stepwright::missions
