#pragma once

// Meaning of the pins of a drawn block. Pure functions; internal to this folder.

#include "ladder/graphic/diagram.h"
#include "ladder/lowering/diagram_graph.h"
#include "ladder/lowering/diagram_scope.h"

namespace stepwright::lowering {

// Whether something leads to the input, or an expression stands at it.
bool is_connected(const graphic::Pin& pin);
// The input EN if it is connected, or null.
const graphic::Pin* enable_of(const graphic::Element& block);
// The output that carries the value of a function.
Origin result_of(const graphic::Element& block, const DiagramScope& scope);

}  // namespace stepwright::lowering
