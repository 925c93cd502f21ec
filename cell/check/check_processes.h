#pragma once

// Check of the processes around a cell's runtime: what they would refuse at their start, in their own words.
// The page and the Modbus server their certificates, the Modbus client its devices, the gateway its line and
// the table of its plan.
//
// Any thread; reads files.
//
// Nothing is opened but files to read: whether an address or a device is free is known at the start only.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

result::Diagnostics check_processes(const config::CellConfig& config);

}  // namespace stepwright::check
