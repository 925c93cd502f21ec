#pragma once

// The names of variables in a cell's alarms, recipes and drawing against its program. C0532: the program has
// no such variable, so that the alarm never comes, the recipe cannot be loaded, or the picture stays pale.
//
// Reads the files that the configuration names; what is wrong with these files themselves is told elsewhere.

#include "cell/config/cell_config.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

// Each at the place of its name, with the nearest name that there is.
result::Diagnostics check_names(const config::CellConfig& config, const reader::ProgramInfo& info);

}  // namespace stepwright::check
