#pragma once

// Warnings about programs that compile: what their authors hardly meant. Codes W0002 to W0015.
//
// Names are followed over the syntax tree, types over the semantic model; each body is walked once, so the
// cost is linear in the size of the program. Nothing is said about POUs that are not the user's (the standard
// library) nor about statements that the lowering of a diagram made.
//
// Pure; no state between calls.
//
//   if (!sink.has_errors()) lint::check(*model, unit, user_pous, lint::Level::Default, sink);

#include "ladder/semantics/model/model.h"
#include "ladder/source/diagnostic_sink.h"

namespace stepwright::lint {

enum class Level : std::uint8_t {
  None,     // no warnings at all
  Default,  // what is nearly always a mistake
  All,      // and what is a matter of taste: unused POUs, names that hide others, empty bodies, REALs
            // compared for equality
};

// Requires a model without errors that was made of `unit`. The first `user_pous` POUs are the user's.
void check(const semantics::Model& model, const syntax::Unit& unit, std::size_t user_pous, Level level,
           source::DiagnosticSink& sink);

// Takes out warnings that a pragma in the source switches off: {no_warning W0003} or {no_warning} on the line
// of the warning, or on a line of its own before it.
result::Diagnostics without_suppressed(result::Diagnostics diagnostics, const source::SourceSet& sources);

}  // namespace stepwright::lint
