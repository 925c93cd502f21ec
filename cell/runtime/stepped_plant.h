#pragma once

// A plant in a process of its own as a cell's configuration has it. Pure but for reading what the plant is
// made of.

#include <memory>

#include "cell/config/cell_config.h"
#include "plant_models/stepped/stepped_plant.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_runtime {

// Its terminals, values and faults, without a process. Fails with what is wrong with them.
[[nodiscard]] result::Result<std::unique_ptr<stepped::SteppedPlant>> stepped_plant(
    const config::PlantConfig& plant);

// How its process is started: the person's own command, or the one of this installation that runs an FMU or a
// program in ST.
stepped::StepCommand stepped_command(const config::CellConfig& cell);

}  // namespace stepwright::cell_runtime
