#pragma once

// Where the stages of the compiler report what is wrong. Not thread-safe; one per compilation.
//
// Reports of the same code at the same place are kept once, and after `kLimit` errors the rest is counted
// only, so that no input makes the report endless.

#include <cstddef>
#include <string>

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

  bool has_errors() const { return errors_ > 0; }
  std::size_t error_count() const { return errors_; }
  // All reports in the order of files and lines; empties the sink.
  result::Diagnostics take();

 private:
  void report(result::Severity severity, const char* code, Position where, std::string message,
              std::string hint);

  struct Report {
    Position where;
    result::Diagnostic diagnostic;
  };
  const SourceSet& sources_;
  std::vector<Report> reports_;
  std::size_t errors_ = 0;
};

}  // namespace stepwright::source
