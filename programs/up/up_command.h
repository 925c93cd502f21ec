#pragma once

// The command `up`: checks what can be known before anything starts, compiles the cell's program, and keeps
// its processes (process_supervisor.h).

#include "programs/up/options.h"

namespace stepwright::up {

// Returns the exit code when the cell is down again; with Options::detach, when it is ready or has failed.
int run_up(const Options& options);

}  // namespace stepwright::up
