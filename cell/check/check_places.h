#pragma once

// The files and folders that a cell writes: whether they can be what its file says. A start of the cell makes
// the state folder, and folders of its own; never the folder of a file that somebody names.
//
// Threads: any. Reads the cell's file for the lines; writes nothing.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

// C0476: a file that is a folder or whose folder is missing, a folder that is none. Where this user may not
// write, or look, it is a warning: the cell may run as another one.
result::Diagnostics check_places(const config::CellConfig& config);

}  // namespace stepwright::check
