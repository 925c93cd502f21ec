#pragma once

// Whether a program that was compiled elsewhere has the monitors of its cell.
//
// Pure; any thread.

#include "cell/config/cell_config.h"
#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::cell_monitors {

// C0558 for each monitor that the program lacks, at its place in the configuration.
result::Diagnostics missing_monitors(const config::CellConfig& config, const reader::ProgramInfo& program);

}  // namespace stepwright::cell_monitors
