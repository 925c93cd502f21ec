#pragma once

// A cell from above as a picture: regions, objects where they start, what is left of each place after the
// propagation, and for each arm how much of a turn its tool reaches at the height of the first place that the
// sequence uses. A pure function; any thread.
//
//   write("cell.svg", cell_svg(network));

#include <string>

#include "supervisor/tamp/intervals/network/network.h"

namespace stepwright::tamp {

std::string cell_svg(const Network& network);

}  // namespace stepwright::tamp
