#pragma once

// Finds servers of a cell that would listen on one port of one address: the page, Modbus, and the figures for
// monitoring. The second of them would not start.
//
// Threads: any. Reads the cell's file for the lines.

#include "cell/config/cell_config.h"

namespace stepwright::check {

// C0473 at the port of the second.
result::Diagnostics check_ports(const config::CellConfig& config);

}  // namespace stepwright::check
