#pragma once

// Charts that several tests draw, lower and write.

#include "ladder/graphic/sfc_chart.h"

namespace stepwright::support {

// One step after the other, as the paper translates its plan (Figure 13), with a jump back to the start.
graphic::SfcChart sequence_chart();

// Simultaneous branches, one of which holds alternative branches.
graphic::SfcChart nested_chart();

// The partial order a < c, a < d, b < d, b < e: simultaneous branches that do not nest, with wait steps.
graphic::SfcChart partial_order_chart();

// All qualifiers, ST actions, elapsed times, several initial steps, loops.
graphic::SfcChart rich_chart();

}  // namespace stepwright::support
