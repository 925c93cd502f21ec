#pragma once

// The model of a plant in a process of its own, as far as it can be read: the FMU and its variables, the
// plant's program in ST and its variables, the program of a command.
//
// Reads files; starts and opens nothing else.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"

namespace stepwright::check {

result::Diagnostics check_plant(const config::CellConfig& config);

}  // namespace stepwright::check
