#pragma once

// Syntax tree -> semantic model. Reports every violation of the language's rules; a name or type that is
// wrong once stays silent afterwards.
//
// Rules worth knowing: conversions are implicit only where no value can be lost (figure 12), everything else
// is written X_TO_Y. Durations convert to and from numbers as milliseconds. A global can be used without
// VAR_EXTERNAL. Function blocks and types may be declared in any order.

#include "ladder/semantics/model/model.h"
#include "ladder/source/diagnostic_sink.h"
#include "ladder/source/dialect.h"

namespace stepwright::semantics {

// The TESTs that are analysed with the rest of a unit, and the POUs of their file that take the place of
// others (MOCK).
struct TestGroup {
  std::vector<const syntax::TestDeclaration*> tests;
  std::vector<const syntax::PouDeclaration*> mocks;
};

struct AnalysisOptions {
  const TestGroup* tests = nullptr;  // the model is one to run them: it needs no main program
  bool library = false;              // nor does what is only checked
  // POUs of the unit from here on, so many, are programs that watch the others (internal/watcher.h).
  // Of each: how many assignments at its beginning take their values from outside.
  std::size_t first_watcher = 0;
  std::vector<std::uint32_t> watchers = {};
  const source::Dialect* dialect = &source::standard_dialect();
};

// `unit` must outlive the model. The first `user_pous` POUs are the user's: one of them is the main program,
// if no configuration says so. If the sink has errors afterwards, the model must not be given to codegen.
std::unique_ptr<Model> analyze(const syntax::Unit& unit, std::size_t user_pous, source::NameTable& names,
                               source::DiagnosticSink& sink, const AnalysisOptions& options = {});

}  // namespace stepwright::semantics
