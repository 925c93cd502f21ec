#pragma once

// The rungs of a chart's action blocks: the ACTION_CONTROL block of IEC 61131-3, 2.6.4.5, with or without
// final scan, written out for the qualifiers that a chart uses. Internal to this folder.

#include "ladder/lowering/sfc_lowering_context.h"

namespace stepwright::lowering {

// Appends the rungs that drive the BOOL targets, in the order of their first action block, and control the
// actions with a body, then those that run the bodies, in the order of the chart's actions. Expects the step
// bits of this scan.
void lower_actions(SfcLoweringContext& context);

}  // namespace stepwright::lowering
