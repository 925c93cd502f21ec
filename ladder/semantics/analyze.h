#pragma once

// Syntax tree -> semantic model. Reports every violation of the language's rules; a name or type that is
// wrong once stays silent afterwards.
//
// Rules worth knowing: conversions are implicit only where no value can be lost (figure 12), everything else
// is written X_TO_Y. Durations convert to and from numbers as milliseconds. A global can be used without
// VAR_EXTERNAL. Function blocks and types may be declared in any order.

#include "ladder/semantics/model.h"
#include "ladder/source/diagnostic_sink.h"

namespace stepwright::semantics {

// `unit` must outlive the model. The first `user_pous` POUs are the user's: one of them is the main program,
// if no configuration says so. If the sink has errors afterwards, the model must not be given to codegen.
std::unique_ptr<Model> analyze(const syntax::Unit& unit, std::size_t user_pous, source::NameTable& names,
                               source::DiagnosticSink& sink);

}  // namespace stepwright::semantics
