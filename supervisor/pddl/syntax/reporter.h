#pragma once

// Collects the diagnostics of one reading, with their places; hints for misspelt names.
//
// Thread rule: one reading, one reporter.

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/result/diagnostic.h"
#include "supervisor/pddl/syntax/ast.h"

namespace stepwright::pddl {

class Reporter {
 public:
  explicit Reporter(std::vector<std::string> files) : files_(std::move(files)) {}

  void error(std::string code, Place at, std::string message, std::string hint = {});
  void warning(std::string code, Place at, std::string message, std::string hint = {});

  bool failed() const { return errors_ > 0; }
  std::size_t errors() const { return errors_; }
  const std::vector<std::string>& files() const { return files_; }

  // Errors and warnings by place.
  result::Diagnostics take();

 private:
  void report(result::Severity severity, std::string code, Place at, std::string message, std::string hint);

  std::vector<std::string> files_;
  result::Diagnostics diagnostics_;
  std::size_t errors_ = 0;
};

// "did you mean 'distance'?" if one of the candidates is close enough to `name`; empty otherwise.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace stepwright::pddl
