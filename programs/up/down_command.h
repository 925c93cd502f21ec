#pragma once

// `stepwright down`: ends a cell that is up, in order.

#include "programs/up/options.h"

namespace stepwright::up {

// Waits until the cell is down. Done also if it was not up; RuntimeFault with M0021 if a process had to be
// killed.
int run_down(const Options& options);

}  // namespace stepwright::up
