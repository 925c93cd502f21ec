#pragma once

// Front end of all compilations: texts and projects become one unit of the syntax tree. Internal to this
// folder; one object per compilation, one thread.

#include <cstddef>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"
#include "ladder/driver/pou_lowering.h"
#include "ladder/semantics/analyze.h"

namespace stepwright::driver {

class FrontEnd {
 public:
  // Reads everything, the parts of the library that it names included. `input` must outlive the front end.
  explicit FrontEnd(const CompileInput& input);
  FrontEnd(const FrontEnd&) = delete;
  FrontEnd& operator=(const FrontEnd&) = delete;

  const syntax::Unit& unit() const { return unit_; }
  std::size_t user_pous() const { return user_pous_; }
  const source::SourceSet& sources() const { return sources_; }
  source::DiagnosticSink& sink() { return sink_; }

  // A model of the unit; with `tests`, one to run them.
  std::unique_ptr<semantics::Model> analyze(const semantics::TestGroup* tests = nullptr);
  // Requires a model of analyze() and a sink without errors.
  [[nodiscard]] result::Result<std::vector<std::byte>> container(const semantics::Model& model) const;
  // The same, but naming files as diagnostics do: it is run at once and kept by nobody.
  [[nodiscard]] result::Result<std::vector<std::byte>> test_container(const semantics::Model& model) const;

  // The tests that are compiled together: those of files without mocks, and those of each file that has some.
  // Reports names that two tests have.
  std::vector<semantics::TestGroup> test_groups();

 private:
  std::string folder_;
  const source::Dialect* dialect_;
  bool library_;
  source::SourceSet sources_;
  source::NameTable names_;
  source::DiagnosticSink sink_;
  syntax::SyntaxContext context_;
  syntax::Unit unit_;
  PouLowering lowering_;
  std::size_t user_pous_ = 0;
  std::span<const Watcher> watchers_;  // POUs from user_pous_ on, one each
};

}  // namespace stepwright::driver
