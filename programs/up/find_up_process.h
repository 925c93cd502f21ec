#pragma once

// Search for the `stepwright up` of a cell's file among the processes of this machine: for when the cell's
// state folder, where it is known, is gone or cannot be found any more.
//
// Threads: any.

#include <sys/types.h>

#include <optional>

#include "programs/up/options.h"

namespace stepwright::up {

// The process that keeps up the cell of this file, with the same overrides of [cell], as one file may make
// several cells; nothing if there is none, or if this user cannot see it.
std::optional<pid_t> find_up_process(const Options& options);

}  // namespace stepwright::up
