#pragma once

// Check that the configuration fits the program: it tells of names that are there and of no use where they
// stand: an alarm on a text, a recipe for another type, a task's settings without the task, a figure of the
// cell that is none.
//
// Pure but for the files that the configuration names; any thread.

#include "cell/config/cell_config.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

// C0528: another type than the program's; C0529: an address that the program does not have; C0532: no such
// figure or task. Variables that are not there are told by check_names.
result::Diagnostics check_fit(const config::CellConfig& config, const reader::ProgramInfo& info);

}  // namespace stepwright::check
