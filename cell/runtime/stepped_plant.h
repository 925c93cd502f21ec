#pragma once

// A plant in a process of its own as a cell's configuration has it: the person's own program, or the one of
// this installation that runs an FMU or a program in ST. Pure.

#include <memory>

#include "cell/config/cell_config.h"
#include "plant_models/stepped/stepped_plant.h"

namespace stepwright::cell_runtime {

// Its process has not been started.
std::unique_ptr<stepped::SteppedPlant> stepped_plant(const config::CellConfig& cell);

}  // namespace stepwright::cell_runtime
