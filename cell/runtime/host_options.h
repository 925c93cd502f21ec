#pragma once

// Options of the runtime's host from a cell's configuration. Any thread.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/host_config.h"

namespace stepwright::cell_runtime {

// Fails with what does not fit this machine; what is wrong in the file is found when that is read.
[[nodiscard]] result::Result<host::HostConfig> host_options(const config::CellConfig& config);

}  // namespace stepwright::cell_runtime
