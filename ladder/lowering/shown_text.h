#pragma once

// Rungs as a reader sees them (shown_ladder.h), as statements: an action that was drawn, in a chart whose
// actions are texts. What is powered stands under its condition, edges are R_EDGE and F_EDGE, connectors >1>.
// Not to be compiled.
//
//   shown_text(shown_ladder(diagram_to_ladder(diagram, scope)))  ->  "lamp := a AND NOT b;\n"

#include <string>

#include "ladder/graphic/ladder_program.h"

namespace stepwright::lowering {

// Jumps and labels, which actions do not have, are left out. Pure.
std::string shown_text(const graphic::LadderProgram& ladder);

}  // namespace stepwright::lowering
