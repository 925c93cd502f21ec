#pragma once

// The rungs of a drawn LD or FBD body, in the order in which they are evaluated: the series and parallel form
// of its networks, which the compiler, the drawings and the exporters read.
//
// A value that several elements read - the power behind a contact that branches, the result of a function -
// becomes a wire, computed once. So does a value that would change before it is used: the power behind a coil
// in the middle of a rung is that before the coil. In a loop without an execution order the leftmost, then
// topmost element goes first: it reads a wire that keeps its value of the last scan (IEC 61131-3, 8.3.3), and
// the comment of the network says so.
//
//   LadderProgram rungs = diagram_to_ladder(diagram, scope);

#include "ladder/graphic/diagram.h"
#include "ladder/graphic/ladder_program.h"
#include "ladder/lowering/diagram_scope.h"

namespace stepwright::lowering {

// Reports what cannot be read (E0803) to the scope. Elements of charts are skipped.
graphic::LadderProgram diagram_to_ladder(const graphic::Diagram& diagram, DiagramScope& scope);

}  // namespace stepwright::lowering
