#pragma once

// `stepwright status`: how a cell that is up is, its processes and its program.

#include "programs/up/options.h"

namespace stepwright::up {

// Done if the cell is up, all its processes are ready, and its program is not in fault; RuntimeFault if not.
int run_status(const Options& options);

}  // namespace stepwright::up
