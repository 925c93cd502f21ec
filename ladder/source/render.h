#pragma once

// Diagnostics as a person at a terminal reads them: the place, the line of the source, a caret, the hint.
//
//   blink.st:4:8: error E0201: 'lampe' is not declared
//     4 |   lampe := TRUE;
//       |   ^
//     hint: did you mean 'lamp'?

#include <cstddef>
#include <span>
#include <string>

#include "ladder/source/source_set.h"

namespace stepwright::source {

struct RenderStyle {
  bool colour = false;  // ANSI colours, for a terminal
  std::size_t width =
      100;  // columns of the source line that are shown; a longer line is cut around the caret
};

// `texts` are searched for the file that the diagnostic names; without it the line is left out.
std::string render(const result::Diagnostic& diagnostic, std::span<const NamedText> texts,
                   const RenderStyle& style = {});

}  // namespace stepwright::source
