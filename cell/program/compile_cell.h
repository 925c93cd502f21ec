#pragma once

// The program of a cell from its [runtime] sources, with the cell's monitors, in memory: what `stepwright up`
// would run.
//
// Reads files; any thread.

#include <cstddef>
#include <optional>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_program {

// Appends what the compiler says of the sources; nothing if they do not compile. What is wrong with monitors
// is not said: who reads them does. Requires that the cell has sources.
std::optional<std::vector<std::byte>> compile_cell(const config::CellConfig& config,
                                                   result::Diagnostics& problems);

}  // namespace stepwright::cell_program
