#include "supervisor/lisp/reporter.h"

#include <algorithm>
#include <tuple>

namespace stepwright::lisp {

namespace {

constexpr std::size_t kLongestText = 500;

// A message may name what stands in the file, and that may be a name of a megabyte.
std::string readable(std::string text) {
  if (text.size() <= kLongestText) return text;
  return text.substr(0, kLongestText / 2) + " ... " + text.substr(text.size() - kLongestText / 4);
}

}  // namespace

void Reporter::report(result::Severity severity, std::string code, Place at, std::string message,
                      std::string hint) {
  message = readable(std::move(message));
  const std::string file = at.file < files_.size() ? files_[at.file] : std::string();
  const auto said = [&](const result::Diagnostic& d) {
    return d.where.line == at.line && d.where.column == at.column && d.where.file == file && d.code == code &&
           d.message == message;
  };
  if (std::any_of(diagnostics_.begin(), diagnostics_.end(), said)) return;
  const auto as_severe = std::count_if(diagnostics_.begin(), diagnostics_.end(),
                                       [&](const result::Diagnostic& d) { return d.severity == severity; });
  if (static_cast<std::size_t>(as_severe) == kMost) {
    ++unsaid_;
    return;
  }
  diagnostics_.push_back(
      {std::move(code), severity, {file, at.line, at.column}, std::move(message), std::move(hint)});
}

void Reporter::error(std::string code, Place at, std::string message, std::string hint) {
  ++errors_;
  report(result::Severity::Error, std::move(code), at, std::move(message), std::move(hint));
}

void Reporter::warning(std::string code, Place at, std::string message, std::string hint) {
  report(result::Severity::Warning, std::move(code), at, std::move(message), std::move(hint));
}

result::Diagnostics Reporter::take() {
  const auto key = [this](const result::Diagnostic& d) {
    const auto file = std::find(files_.begin(), files_.end(), d.where.file) - files_.begin();
    return std::make_tuple(file, d.where.line, d.where.column);
  };
  std::stable_sort(diagnostics_.begin(), diagnostics_.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  if (unsaid_ > 0) {
    diagnostics_.push_back({"P0010", result::Severity::Note, diagnostics_.back().where,
                            "and " + std::to_string(unsaid_) + " more that are not listed",
                            "mend the first ones first: others often follow from them"});
  }
  return std::move(diagnostics_);
}

}  // namespace stepwright::lisp
