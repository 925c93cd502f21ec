#include "ladder/source/diagnostic_sink.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace stepwright::source {

void DiagnosticSink::error(const char* code, Position where, std::string message, std::string hint) {
  if (!is_kept(result::Severity::Error)) return;
  keep({code, result::Severity::Error, sources_.location(where), noted(where, std::move(message)),
        std::move(hint)});
}

void DiagnosticSink::warning(const char* code, Position where, std::string message, std::string hint) {
  if (!is_kept(result::Severity::Warning)) return;
  keep({code, result::Severity::Warning, sources_.location(where), noted(where, std::move(message)),
        std::move(hint)});
}

std::string DiagnosticSink::noted(Position where, std::string message) const {
  const std::string note = sources_.note(where);
  return note.empty() ? message : note + ": " + message;
}

void DiagnosticSink::add(result::Diagnostics diagnostics) {
  for (auto& each : diagnostics) report(std::move(each));
}

void DiagnosticSink::report(result::Diagnostic diagnostic) {
  if (is_kept(diagnostic.severity)) keep(std::move(diagnostic));
}

bool DiagnosticSink::is_kept(result::Severity severity) {
  const bool is_error = severity == result::Severity::Error;
  if (is_error) ++errors_;
  const std::size_t kept = is_error ? kept_errors_ : reports_.size() - kept_errors_;
  if (kept < kLimit) return true;
  ++left_out_;
  return false;
}

void DiagnosticSink::keep(result::Diagnostic diagnostic) {
  const result::Location& where = diagnostic.where;
  // What has no line is told apart by its words.
  const std::string what = where.line > 0 ? diagnostic.code : diagnostic.code + diagnostic.message;
  if (!known_.emplace(where.file, where.line, where.column, what).second) return;
  if (diagnostic.severity == result::Severity::Error) ++kept_errors_;
  reports_.push_back(std::move(diagnostic));
}

result::Diagnostics DiagnosticSink::take() {
  std::unordered_map<std::string, std::size_t> order;
  for (std::size_t i = 0; i < sources_.size(); ++i)
    order.try_emplace(sources_.name(FileId(static_cast<std::uint32_t>(i))), i);
  // Files that are none of the sources come last.
  const auto rank = [&](const result::Diagnostic& each) {
    const auto found = order.find(each.where.file);
    return std::tuple(found == order.end() ? order.size() : found->second, each.where.line,
                      each.where.column);
  };
  std::stable_sort(reports_.begin(), reports_.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  result::Diagnostics diagnostics = std::move(reports_);
  if (left_out_ > 0)
    diagnostics.push_back(
        {code::kTooMany, result::Severity::Note, {}, std::to_string(left_out_) + " more are not shown", {}});
  reports_.clear();
  known_.clear();
  errors_ = kept_errors_ = left_out_ = 0;
  return diagnostics;
}

}  // namespace stepwright::source
