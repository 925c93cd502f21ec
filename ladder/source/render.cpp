#include "ladder/source/render.h"

#include <algorithm>
#include <string_view>

#include "ladder/source/excerpt.h"

namespace stepwright::source {

namespace {

constexpr std::string_view kBold = "\x1b[1m";
constexpr std::string_view kRed = "\x1b[1;31m";
constexpr std::string_view kYellow = "\x1b[1;33m";
constexpr std::string_view kCyan = "\x1b[1;36m";
constexpr std::string_view kGreen = "\x1b[1;32m";
constexpr std::string_view kPlain = "\x1b[0m";

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

std::string_view colour_of(result::Severity severity) {
  switch (severity) {
    case result::Severity::Note:
      return kCyan;
    case result::Severity::Warning:
      return kYellow;
    case result::Severity::Error:
      break;
  }
  return kRed;
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

class Painter {
 public:
  explicit Painter(bool colour) : colour_(colour) {}

  std::string operator()(std::string_view colour, const std::string& text) const {
    return colour_ ? std::string(colour) + text + std::string(kPlain) : text;
  }

 private:
  bool colour_;
};

}  // namespace

std::string render(const result::Diagnostic& diagnostic, std::span<const NamedText> texts,
                   const RenderStyle& style) {
  const Painter paint(style.colour);
  const auto& where = diagnostic.where;
  std::string place = where.file;
  if (where.line > 0) place += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
  if (!place.empty()) place += ":";
  std::string out = place.empty() ? "" : paint(kBold, place) + " ";
  const std::string code = diagnostic.code.empty() ? "" : " " + diagnostic.code;
  out += paint(colour_of(diagnostic.severity), word(diagnostic.severity) + code + ":") + " " +
         diagnostic.message + "\n";
  const auto file = std::find_if(texts.begin(), texts.end(),
                                 [&](const NamedText& each) { return each.name == where.file; });
  if (file != texts.end() && where.line > 0) {
    const std::string number = std::to_string(where.line);
    const Excerpt shown = excerpt(line_of(file->text, where.line), where.column, style.width);
    out += "  " + number + " | " + shown.line + "\n";
    out += "  " + std::string(number.size(), ' ') + " | " + shown.indent + paint(kGreen, "^") + "\n";
  }
  if (!diagnostic.hint.empty()) out += "  " + paint(kCyan, "hint:") + " " + diagnostic.hint + "\n";
  return out;
}

}  // namespace stepwright::source
