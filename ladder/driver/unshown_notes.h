#pragma once

// Warns of what pragmas (syntax/tag_pragma.h) say of a variable that is no tag: only what has a value and
// lasts is shown, so an instance, a structure, a VAR_TEMP or a variable of a function shows nothing of it.
//
// Pure; use from any thread.

#include <vector>

#include "ladder/graphic/sheet.h"
#include "ladder/semantics/model/model.h"
#include "ladder/source/diagnostic_sink.h"

namespace stepwright::driver {

// `sheets` are those of the sources that `model` was made of.
void warn_of_unshown_notes(const std::vector<graphic::Sheet>& sheets, const semantics::Model& model,
                           source::DiagnosticSink& sink);

}  // namespace stepwright::driver
