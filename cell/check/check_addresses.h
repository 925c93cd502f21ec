#pragma once

// Finds addresses of this machine in a cell's file that this machine does not have now: what is to listen
// there would not start. A warning, since the cell may be meant for another machine.
//
// Threads: any. Reads the cell's file for the lines.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

// C0474 at the host of a server, or at [dds] interfaces.
result::Diagnostics check_addresses(const config::CellConfig& config);

}  // namespace stepwright::check
