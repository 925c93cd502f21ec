#pragma once

// Document of a program for viewers: the sheets with their bodies, and every use of every variable, as JSON.
// Browsers show it with live values; hmi_web/doc/program.md says what each member means. The container
// carries it in its section Document.
//
//   container = writer::with_document(container, print::program_document(sheets));
//
// Pure: the same sheets give the same text. UTF-8; bytes of a source that are none are replaced.

#include <string>
#include <vector>

#include "ladder/graphic/sheet.h"

namespace stepwright::print {

std::string program_document(const std::vector<graphic::Sheet>& sheets);

}  // namespace stepwright::print
