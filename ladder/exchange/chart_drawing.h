#pragma once

// A chart that was made by program as a drawn SFC body, with its actions: what the writer of drawn bodies
// takes. The layout is that of the drawings (ladder/graphic/sfc_layout.h). Internal to this folder.

#include "ladder/graphic/project.h"

namespace stepwright::exchange {

// Requires a sound chart. Where alternative branches are tested in another order than from left to right, or
// could be, the transitions say their priorities.
graphic::DrawnBody draw_chart(const graphic::SfcChart& chart);

}  // namespace stepwright::exchange
