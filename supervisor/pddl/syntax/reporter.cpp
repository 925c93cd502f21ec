#include "supervisor/pddl/syntax/reporter.h"

#include <algorithm>
#include <tuple>

namespace stepwright::pddl {
namespace {

// Insertions, deletions, replacements and swaps of neighbours, each counted once.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

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
  std::size_t best = std::max<std::size_t>(1, name.size() / 3) + 1;
  const std::string* found = nullptr;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best) {
      best = distance;
      found = &candidate;
    }
  }
  return found == nullptr ? std::string() : "did you mean '" + *found + "'?";
}

}  // namespace stepwright::pddl
