#pragma once

// Globals that a program's text uses: who writes programs as text and charts declares exactly those. Pure
// functions; any thread.
//
//   pou.variables = externals(project.globals, text);

#include <string>
#include <string_view>
#include <vector>

#include "ladder/graphic/project.h"

namespace stepwright::graphic {

// Whether the name stands in the text as a whole word. Names are compared as they are written.
bool mentions(std::string_view text, std::string_view name);

// The globals whose names the text mentions, as VAR_EXTERNAL, in their order.
std::vector<Variable> externals(const std::vector<Variable>& globals, std::string_view text);

// All of a chart that can mention a variable: actions and conditions.
std::string text_of(const SfcChart& chart);

}  // namespace stepwright::graphic
