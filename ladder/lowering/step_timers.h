#pragma once

// Rewrites a chart for controllers without a TIME type: `STEP.T >= T#2s` in a transition out of STEP becomes
// a flag that a D action of STEP sets (an on-delay timer when lowered). The transition fires one scan later
// than with the elapsed time, because actions are evaluated after transitions. Pure function.
//
//   exchange::write_omron(*lowering::lower_sfc(lowering::with_step_timers(pou)), options)

#include "ladder/graphic/project.h"

namespace stepwright::lowering {

// `pou` holds a chart. Other uses of `.T` (another operator, another step, an expression) stay as they are.
graphic::Pou with_step_timers(graphic::Pou pou);

}  // namespace stepwright::lowering
