#pragma once

// A program as a viewer reads it: the sheets with their bodies, and every use of every variable, as JSON.
// What a browser shows live; hmi_web/doc/program.md says what each member means. The container carries it
// in its section Document.
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
