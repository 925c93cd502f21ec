#pragma once

// Rungs that were made by program as a drawn LD body: what the writer of drawn bodies takes. Internal to this
// folder.
//
// Contacts and coils are themselves; a comparison is the standard function, joined to the power by an AND, so
// that no reader needs to know what an output of a function without power holds. Statement lists of
// assignments are MOVE blocks.

#include "ladder/graphic/diagram.h"
#include "ladder/graphic/ladder_program.h"
#include "runtime/ground/result/result.h"

namespace stepwright::exchange {

// Fails with E0814, naming POU and rung, where a rung holds statements that are no plain assignments.
[[nodiscard]] result::Result<graphic::Diagram> draw_ladder(const graphic::LadderProgram& ladder,
                                                           const std::string& pou);

}  // namespace stepwright::exchange
