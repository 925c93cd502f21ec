#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "ladder/lint/lint.h"

namespace stepwright::lint {

namespace {

constexpr std::string_view kPragma = "no_warning";
constexpr std::string_view kBlank = " \t\r";

std::string_view line_of(const source::SourceSet& sources, source::FileId file, std::uint32_t line) {
  const std::uint32_t begin = sources.line_start(file, line);
  const std::string_view rest = sources.text(file).substr(begin);
  return rest.substr(0, rest.find('\n'));
}

// The code stands in the list behind the word, or the list is empty.
bool names(std::string_view pragma, std::string_view code) {
  const std::string_view list = pragma.substr(kPragma.size());
  return list.find_first_not_of(" \t,") == std::string_view::npos ||
         list.find(code) != std::string_view::npos;
}

// A pragma of the line switches the code off; `only` is set if the line holds nothing else.
bool switches_off(std::string_view line, std::string_view code, bool& only) {
  for (std::size_t at = line.find('{'); at != std::string_view::npos; at = line.find('{', at + 1)) {
    const std::size_t end = line.find('}', at);
    if (end == std::string_view::npos) return false;
    std::string_view inside = line.substr(at + 1, end - at - 1);
    inside.remove_prefix(std::min(inside.find_first_not_of(kBlank), inside.size()));
    if (inside.substr(0, kPragma.size()) != kPragma || !names(inside, code)) continue;
    only = line.find_first_not_of(kBlank) == at && line.find_last_not_of(kBlank) == end;
    return true;
  }
  return false;
}

bool is_suppressed(const result::Diagnostic& each, const source::SourceSet& sources, source::FileId file) {
  bool only = false;
  if (switches_off(line_of(sources, file, each.where.line), each.code, only)) return true;
  if (each.where.line < 2) return false;
  return switches_off(line_of(sources, file, each.where.line - 1), each.code, only) && only;
}

}  // namespace

result::Diagnostics without_suppressed(result::Diagnostics diagnostics, const source::SourceSet& sources) {
  std::unordered_map<std::string_view, source::FileId> files;
  for (std::uint32_t i = 0; i < sources.size(); ++i) {
    const source::FileId file(i);
    files.try_emplace(sources.name(file), file);
  }
  std::erase_if(diagnostics, [&](const result::Diagnostic& each) {
    const auto file = files.find(each.where.file);
    return each.severity == result::Severity::Warning && file != files.end() && each.where.line > 0 &&
           is_suppressed(each, sources, file->second);
  });
  return diagnostics;
}

}  // namespace stepwright::lint
