#pragma once

// Starts the guard of the cell beside the runtime, as a process that survives it.
//
// Threads: before any other thread of the process exists.

#include "programs/config/cell_config.h"
#include "runtime/result/result.h"

namespace stepwright::cell_runtime {

// Returns once the guard watches; what it prints goes to guard.log in the state folder. It ends by itself
// when this process is gone and nobody drives the outputs. Fails with R0046, for example if another guard is
// there.
[[nodiscard]] result::Result<void> start_guard(const config::CellConfig& config);

}  // namespace stepwright::cell_runtime
