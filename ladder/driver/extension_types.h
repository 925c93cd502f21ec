#pragma once

// Extensions of the editors of the matiec family beside the standard (Dialect::extension_types): types of
// their pages, and blocks that run Python beside the program. Types are known by their base; the blocks are
// opaque: they can be called and do nothing. Internal to this folder.
//
// Threads: that of the compilation. Invariant: what the sources declare themselves stays as it is.

#include <string_view>

#include "ladder/syntax/parser.h"

namespace stepwright::driver {

// Whether a type of this name, in upper case, is one of them.
bool is_extension_type(std::string_view name);

// Adds what the unit names of them and does not declare itself.
void add_extension_types(syntax::SyntaxContext& context, syntax::Unit& unit);

}  // namespace stepwright::driver
