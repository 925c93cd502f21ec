#pragma once

// The types of what flows through a diagram: a wire is a variable and needs one. Internal to this folder.

#include <string>

#include "ladder/lowering/diagram_graph.h"

namespace stepwright::lowering {

// ST type of an output; empty if it cannot be told. Standard functions have the type of their widest input,
// or the one that their name says (6.6.2.5).
std::string type_of(const Origin& origin, const DiagramGraph& graph, const DiagramScope& scope);

// ST type of a literal or variable; empty if it is an expression or unknown. "INT" for 5, "REAL" for 1.5.
std::string type_of_text(const std::string& text, const DiagramScope& scope);

}  // namespace stepwright::lowering
