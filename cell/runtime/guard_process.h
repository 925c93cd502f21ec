#pragma once

// Starts the guard of the cell beside the runtime, as a process that survives it.
//
// Threads: any; the process is made without a copy of this one's memory, so that a scan notices nothing.

#include <sys/types.h>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_runtime {

// A guard that is on its way; what it prints goes to guard.log in the state folder. It ends by itself when
// this process is gone and nobody drives the outputs. It is a child of this process, which has to wait for
// its end (waitpid). `ready`: a descriptor to which it writes a byte once it watches, or -1. Fails with
// R0046.
[[nodiscard]] result::Result<pid_t> spawn_guard(const config::CellConfig& config, int ready = -1);

// Returns once it watches. Fails with R0046, for example if another guard is there.
[[nodiscard]] result::Result<pid_t> start_guard(const config::CellConfig& config);

}  // namespace stepwright::cell_runtime
