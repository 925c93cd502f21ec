#pragma once

// Sink of diagnostics, to which the stages of the compiler report what is wrong. Not thread-safe; one per
// compilation.
//
// Reports of the same code at the same place are kept once, and after `kLimit` errors and as many warnings
// the rest is counted only, so that no input makes the report endless.

#include <cstddef>
#include <set>
#include <string>
#include <tuple>

#include "ladder/source/codes.h"
#include "ladder/source/source_set.h"

namespace stepwright::source {

class DiagnosticSink {
 public:
  static constexpr std::size_t kLimit = 200;

  // `sources` must outlive the sink.
  explicit DiagnosticSink(const SourceSet& sources) : sources_(sources) {}

  void error(const char* code, Position where, std::string message, std::string hint = {});
  void warning(const char* code, Position where, std::string message, std::string hint = {});
  // Diagnostics of another module, with their own places.
  void add(result::Diagnostics diagnostics);

  const SourceSet& sources() const { return sources_; }
  bool has_errors() const { return errors_ > 0; }
  std::size_t error_count() const { return errors_; }
  // Further errors are counted only: what explains them need not be looked for.
  bool is_full() const { return kept_errors_ >= kLimit; }
  // All reports in the order of files, lines and columns, and a note if some were left out; empties the sink.
  result::Diagnostics take();

 private:
  void report(result::Diagnostic diagnostic);
  // Counts a report; false if that is all that is done with it.
  bool is_kept(result::Severity severity);
  void keep(result::Diagnostic diagnostic);
  // With what the sources say of the place.
  std::string noted(Position where, std::string message) const;

  const SourceSet& sources_;
  result::Diagnostics reports_;
  // File, line, column and code of what was reported.
  std::set<std::tuple<std::string, std::uint32_t, std::uint32_t, std::string>> known_;
  std::size_t errors_ = 0;
  std::size_t kept_errors_ = 0;
  std::size_t left_out_ = 0;
};

}  // namespace stepwright::source
