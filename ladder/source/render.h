#pragma once

// Diagnostics as a person at a terminal reads them: the place, the line of the source, a caret, the hint.
//
//   blink.st:4:8: error E0201: 'lampe' is not declared
//     4 |   lampe := TRUE;
//       |   ^
//     hint: did you mean 'lamp'?

#include <span>
#include <string>

#include "ladder/source/source_set.h"

namespace stepwright::source {

// `texts` are searched for the file that the diagnostic names; without it the line is left out.
std::string render(const result::Diagnostic& diagnostic, std::span<const NamedText> texts);

}  // namespace stepwright::source
