#pragma once

// Blanks between two tokens (IEC 61131-3, 6.1.4, 6.1.5 and 6.2): white space, comments and pragmas. The one
// place that knows how they begin and end. Pure; use from any thread.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stepwright::syntax {

enum class BlankKind : std::uint8_t { None, Space, Comment, Pragma };

struct Blank {
  BlankKind kind = BlankKind::None;
  std::string_view open;   // of a comment or pragma: "(*", "/*", "//", "{", "{{"
  std::string_view close;  // what closes it; empty for "//", which ends before the end of its line
  std::size_t end = 0;     // behind it; the end of the text if it is not closed
  bool closed = true;
};

// The blank that begins at `at`; None where a token begins or the text ends. Comments of one kind nest.
Blank blank_at(std::string_view text, std::size_t at);

}  // namespace stepwright::syntax
