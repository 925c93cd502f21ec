#include "runtime/ground/result/diagnostic.h"

#include <algorithm>

namespace stepwright::result {

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.where.file;
  if (diagnostic.where.line != 0) {
    if (text.empty()) text = "<input>";
    text += ":" + std::to_string(diagnostic.where.line);
    if (diagnostic.where.column != 0) text += ":" + std::to_string(diagnostic.where.column);
  }
  if (!text.empty()) text += ": ";
  if (diagnostic.severity == Severity::Warning) text += "warning: ";
  if (diagnostic.severity == Severity::Note) text += "note: ";
  if (!diagnostic.code.empty()) text += diagnostic.code + ": ";
  text += diagnostic.message;
  if (!diagnostic.hint.empty()) text += "\n  hint: " + diagnostic.hint;
  return text;
}

std::string to_string(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += "\n";
    text += to_string(diagnostic);
  }
  return text;
}

bool has_errors(const Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

}  // namespace stepwright::result
