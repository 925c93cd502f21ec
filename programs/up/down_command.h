#pragma once

// The commands about a cell that is up: `down` ends it in order, `status` says how it is.

#include "programs/up/options.h"

namespace stepwright::up {

// Waits until the cell is down. Done also if it was not up.
int run_down(const Options& options);
// Done if the cell is up and all its processes are ready; RuntimeFault if not.
int run_status(const Options& options);

}  // namespace stepwright::up
