#pragma once

// The rules that look at the program as a whole, after the walk over its bodies.

#include <set>

#include "ladder/lint/internal/uses.h"
#include "ladder/lint/lint.h"
#include "ladder/source/diagnostic_sink.h"

namespace stepwright::lint::internal {

// The programs that run and everything that they use, with the instances that lead there.
struct Reached {
  std::unordered_map<const semantics::Pou*, std::set<std::string>> by;  // POU -> names of program instances
};
Reached reached_of(const semantics::Model& model);

// W0003, W0004: declared and never used.
void check_unused(Uses& uses, source::DiagnosticSink& sink);
// W0005: a POU that no program uses.
void check_unused_pous(const Uses& uses, const Reached& reached, source::DiagnosticSink& sink);
// W0006: read, but never written; an output or result that nothing writes.
void check_never_written(const Uses& uses, source::DiagnosticSink& sink);
// W0007: an output that several places drive.
void check_outputs(const Uses& uses, const Reached& reached, const source::SourceSet& sources,
                   source::DiagnosticSink& sink);
// W0013: a name that hides another.
void check_hidden(const Uses& uses, source::DiagnosticSink& sink);
// W0002: results of functions that do nothing else.
void check_dropped(const Uses& uses, source::DiagnosticSink& sink);
// W0011, W0014 and, at Level::All, W0010: what the types of expressions show.
void check_values(const semantics::Pou& pou, Level level, source::DiagnosticSink& sink);

}  // namespace stepwright::lint::internal
