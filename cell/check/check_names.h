#pragma once

// The names of variables in a cell's alarms, recipes and drawing against its program. C0532: the program has
// no such variable, so that the alarm never comes, the recipe cannot be loaded, or the picture stays pale.
//
// Likewise, as warnings (C0634), what the page's server keeps: trends that are saved and what is forced.
//
// Reads the files that the configuration names; what is wrong with these files themselves is told elsewhere.

#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

// Ids of the points of the plant's picture.
std::vector<std::string> picture_points(const config::CellConfig& config);
// Each at the place of its name, with the nearest name that there is.
result::Diagnostics check_names(const config::CellConfig& config, const reader::ProgramInfo& info);

}  // namespace stepwright::check
