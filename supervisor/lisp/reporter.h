#pragma once

// Collects the diagnostics of one reading, with their places.
//
// Thread rule: one reading, one reporter.

#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/lisp/place.h"

namespace stepwright::lisp {

class Reporter {
 public:
  explicit Reporter(std::vector<std::string> files) : files_(std::move(files)) {}

  void error(std::string code, Place at, std::string message, std::string hint = {});
  void warning(std::string code, Place at, std::string message, std::string hint = {});

  bool failed() const { return errors_ > 0; }
  // Further errors are only counted.
  bool full() const { return errors_ >= kMost; }
  std::size_t errors() const { return errors_; }
  const std::vector<std::string>& files() const { return files_; }

  // Errors and warnings by place, each once; the first kMost of either, and a note (P0010) that counts the
  // others. What is too long to be read is cut in its middle.
  result::Diagnostics take();

  static constexpr std::size_t kMost = 50;

 private:
  void report(result::Severity severity, std::string code, Place at, std::string message, std::string hint);

  std::vector<std::string> files_;
  result::Diagnostics diagnostics_;
  std::size_t errors_ = 0;
  std::size_t unsaid_ = 0;  // errors and warnings beyond kMost
};

}  // namespace stepwright::lisp
