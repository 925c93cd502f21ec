#pragma once

// List of the processes that a cell needs, by its file, in the order in which they start and end.
//
// What drives outputs starts behind the others: an occupied port or a wrong file is found before anything
// moves. At the end the runtime is stopped behind those who command it, so that its outputs go to their safe
// state; a Modbus client ends behind the runtime, as it carries them to the devices.
//
// Pure; any thread.
//
//   for (const std::string& name : starting_order(config)) ...    // "link", "hmi", "runtime"

#include <string>
#include <vector>

#include "cell/config/cell_config.h"

namespace stepwright::processes {

// Names of commands: `stepwright NAME --config CELL.toml`. The guard is not among them: the runtime has it.
std::vector<std::string> starting_order(const config::CellConfig& config);
std::vector<std::string> ending_order(const config::CellConfig& config);

}  // namespace stepwright::processes
