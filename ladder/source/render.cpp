#include "ladder/source/render.h"

#include <algorithm>
#include <string_view>

namespace stepwright::source {

namespace {

const char* word(result::Severity severity) {
  switch (severity) {
    case result::Severity::Note:
      return "note";
    case result::Severity::Warning:
      return "warning";
    case result::Severity::Error:
      break;
  }
  return "error";
}

std::string_view line_of(std::string_view text, std::uint32_t line) {
  std::size_t start = 0;
  for (std::uint32_t i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string_view::npos) return {};
    start = end + 1;
  }
  std::string_view rest = text.substr(start);
  rest = rest.substr(0, rest.find('\n'));
  if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
  return rest;
}

// White space up to the column; tabs are kept so that the caret stands below its character.
std::string indent_to(std::string_view line, std::uint32_t column) {
  std::string indent;
  std::uint32_t seen = 1;
  for (const char c : line) {
    if ((static_cast<unsigned char>(c) & 0xC0u) == 0x80u) continue;
    if (seen++ >= column) break;
    indent += c == '\t' ? '\t' : ' ';
  }
  return indent;
}

}  // namespace

std::string render(const result::Diagnostic& diagnostic, std::span<const NamedText> texts) {
  const auto& where = diagnostic.where;
  std::string out = where.file;
  if (where.line > 0) out += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
  if (!out.empty()) out += ": ";
  out += std::string(word(diagnostic.severity)) + " " + diagnostic.code + ": " + diagnostic.message + "\n";
  const auto file = std::find_if(texts.begin(), texts.end(),
                                 [&](const NamedText& each) { return each.name == where.file; });
  if (file != texts.end() && where.line > 0) {
    const std::string number = std::to_string(where.line);
    const std::string_view line = line_of(file->text, where.line);
    out += "  " + number + " | " + std::string(line) + "\n";
    out += "  " + std::string(number.size(), ' ') + " | " + indent_to(line, where.column) + "^\n";
  }
  if (!diagnostic.hint.empty()) out += "  hint: " + diagnostic.hint + "\n";
  return out;
}

}  // namespace stepwright::source
