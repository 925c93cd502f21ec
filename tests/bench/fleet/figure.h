#pragma once

// Figure 4 of the paper, redrawn: mean time over the number of vehicles, on a logarithmic scale, as SVG.

#include <span>
#include <string>

#include "tests/bench/fleet/measure.h"

namespace stepwright::bench::fleet {

std::string figure_4(std::span<const CircleRow> rows);

}  // namespace stepwright::bench::fleet
