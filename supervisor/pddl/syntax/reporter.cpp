#include "supervisor/pddl/syntax/reporter.h"

#include <algorithm>
#include <tuple>

#include "runtime/result/closest.h"

namespace stepwright::pddl {

void Reporter::report(result::Severity severity, std::string code, Place at, std::string message,
                      std::string hint) {
  const std::string file = at.file < files_.size() ? files_[at.file] : std::string();
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
  return std::move(diagnostics_);
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string* found = result::closest(name, candidates, std::max<std::size_t>(1, name.size() / 3));
  return found == nullptr ? std::string() : "did you mean '" + *found + "'?";
}

}  // namespace stepwright::pddl
