#pragma once

// Places in the texts of a reading, and the texts themselves.
//
// Thread rule: plain values.

#include <cstdint>
#include <string>

namespace stepwright::lisp {

// A place in one of the texts; `file` is its number in the order of the Reporter's files.
struct Place {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t file = 0;
};

// A text and the name it is known by in diagnostics.
struct Source {
  std::string file;
  std::string text;
};

}  // namespace stepwright::lisp
