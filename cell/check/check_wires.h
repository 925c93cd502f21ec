#pragma once

// The inputs and outputs of a program against the wires of the cell's simulated plant. C0531 (a warning): no
// port of the plant is wired to where the program has a variable, so that the input never changes or the
// output moves nothing.
//
// Pure; any thread.

#include "cell/config/cell_config.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

// Nothing for a cell whose I/O is not its own plant. One warning for each place, at the cell's ports.
result::Diagnostics check_wires(const config::CellConfig& config, const reader::ProgramInfo& info);

}  // namespace stepwright::check
