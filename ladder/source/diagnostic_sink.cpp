#include "ladder/source/diagnostic_sink.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace stepwright::source {

void DiagnosticSink::error(const char* code, Position where, std::string message, std::string hint) {
  report(result::Severity::Error, code, where, std::move(message), std::move(hint));
}

void DiagnosticSink::warning(const char* code, Position where, std::string message, std::string hint) {
  report(result::Severity::Warning, code, where, std::move(message), std::move(hint));
}

void DiagnosticSink::report(result::Severity severity, const char* code, Position where, std::string message,
                            std::string hint) {
  if (severity == result::Severity::Error) ++errors_;
  if (reports_.size() >= kLimit) return;
  for (const Report& earlier : reports_)
    if (earlier.where == where && earlier.diagnostic.code == code) return;
  const std::string note = sources_.note(where);
  if (!note.empty()) message = note + ": " + message;
  reports_.push_back(
      {where, {code, severity, sources_.location(where), std::move(message), std::move(hint)}});
}

void DiagnosticSink::add(result::Diagnostics diagnostics) {
  // They have no offset in our sources: sorted behind everything that has one.
  const Position behind{FileId(static_cast<std::uint32_t>(sources_.size())), 0};
  for (auto& diagnostic : diagnostics) {
    if (diagnostic.severity == result::Severity::Error) ++errors_;
    reports_.push_back({behind, std::move(diagnostic)});
  }
}

result::Diagnostics DiagnosticSink::take() {
  std::stable_sort(reports_.begin(), reports_.end(), [](const Report& a, const Report& b) {
    return std::tuple(a.where.file.value, a.where.offset) < std::tuple(b.where.file.value, b.where.offset);
  });
  result::Diagnostics diagnostics;
  diagnostics.reserve(reports_.size());
  for (Report& each : reports_) diagnostics.push_back(std::move(each.diagnostic));
  reports_.clear();
  errors_ = 0;
  return diagnostics;
}

}  // namespace stepwright::source
