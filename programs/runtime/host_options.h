#pragma once

// What a cell's configuration says to the host of its runtime.

#include "programs/config/cell_config.h"
#include "runtime/host/host_config.h"
#include "runtime/result/result.h"

namespace stepwright::cell_runtime {

// Fails with every safe output whose address is malformed (C0302), no output, or outside the area (C0303).
[[nodiscard]] result::Result<host::HostConfig> host_options(const config::CellConfig& config);

}  // namespace stepwright::cell_runtime
