#pragma once

// The standard library: function blocks, functions and types in ST (ladder/driver/library), described in
// ladder/doc/standard_library.md.
//
// A compilation reads only what its sources name, directly or through other parts of the library: the text is
// searched for the beginnings of declarations (microseconds), and the ones whose names occur are parsed. The
// rest costs nothing, and what is parsed but not used reaches no container.
//
// The blocks of the standard (SR .. TP) have their names for themselves. Other names a user's source may give
// to a POU or type of its own, which then takes the place of the library's.
//
// Pure; no state between calls.

#include <cstdint>
#include <string_view>
#include <vector>

#include "ladder/syntax/parser.h"

namespace stepwright::driver {

// One FUNCTION, FUNCTION_BLOCK or TYPE of the library.
struct LibraryDeclaration {
  std::string_view name;  // as it is spelt
  std::string_view file;  // "library/timers.st"
  std::size_t text = 0;   // index of the file
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  bool reserved = false;  // no user may declare this name
};

// Everything that the library declares, file by file.
std::vector<LibraryDeclaration> library_declarations();

// Appends the declarations that the names in `context` call for. Reports user declarations that take reserved
// names.
void add_library(syntax::SyntaxContext& context, syntax::Unit& unit);

}  // namespace stepwright::driver
