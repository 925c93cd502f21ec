#pragma once

// The names of a chart against the variables around it: what graphic::check cannot see. Internal to this
// folder.

#include <vector>

#include "ladder/graphic/project.h"
#include "runtime/ground/result/result.h"

namespace stepwright::lowering {

// E0721 to E0726, see sfc_to_ladder.h. `globals` may be null: then an undeclared target or
// indicator passes, because it may be a global. Requires a body that holds a sound chart.
[[nodiscard]] result::Diagnostics check_names(const graphic::Pou& pou,
                                              const std::vector<graphic::Variable>* globals);

}  // namespace stepwright::lowering
