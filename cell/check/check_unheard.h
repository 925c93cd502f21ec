#pragma once

// Check for alarms that nobody would be told of: alarms are kept and told with a history only.
//
// Threads: any. Reads the cell's file for the lines.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

// C0475 at [history] alarms and [[notify]] without [history] folder; a warning at monitors whose verdict is
// to be an alarm, and is a variable all the same.
result::Diagnostics check_unheard(const config::CellConfig& config);

}  // namespace stepwright::check
