#pragma once

// The rungs of a drawn body as a reader sees them: without the wires that its evaluation needs.
//
// A wire that one contact reads is the line that was drawn before that contact: what powers it stands there
// again. What is read several times, or in a text, is a connector: >1> where the line ends and wherever it
// goes on (IEC 61131-3, 8.1.3). Rungs shown so are not to be compiled.
//
//   sheet.body = shown_ladder(diagram_to_ladder(diagram, scope));

#include "ladder/graphic/ladder_program.h"

namespace stepwright::lowering {

// Texts must not bear marks. Pure.
graphic::LadderProgram shown_ladder(graphic::LadderProgram ladder);

}  // namespace stepwright::lowering
