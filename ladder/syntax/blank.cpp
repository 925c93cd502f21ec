#include "ladder/syntax/blank.h"

#include <algorithm>

namespace stepwright::syntax {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

Blank comment(std::string_view text, std::size_t at, std::string_view open, std::string_view close) {
  Blank blank{BlankKind::Comment, open, close, text.size(), false};
  int depth = 0;
  while (at < text.size()) {
    const std::string_view here = text.substr(at, 2);
    if (here == open) ++depth;
    if (here == close && --depth == 0) {
      blank.end = at + close.size();
      blank.closed = true;
      return blank;
    }
    at += here == open || here == close ? 2 : 1;
  }
  return blank;
}

Blank pragma(std::string_view text, std::size_t at) {
  const bool doubled = text.substr(at, 2) == "{{";
  Blank blank{BlankKind::Pragma, doubled ? "{{" : "{", doubled ? "}}" : "}", text.size(), false};
  const std::size_t end = text.find(blank.close, at);
  if (end == std::string_view::npos) return blank;
  blank.end = end + blank.close.size();
  blank.closed = true;
  return blank;
}

}  // namespace

Blank blank_at(std::string_view text, std::size_t at) {
  if (at >= text.size()) return {};
  if (is_space(text[at])) {
    std::size_t end = at + 1;
    while (end < text.size() && is_space(text[end])) ++end;
    return {BlankKind::Space, {}, {}, end, true};
  }
  const std::string_view two = text.substr(at, 2);
  if (two == "(*") return comment(text, at, "(*", "*)");
  if (two == "/*") return comment(text, at, "/*", "*/");
  if (two == "//") return {BlankKind::Comment, "//", {}, std::min(text.find('\n', at), text.size()), true};
  if (text[at] == '{') return pragma(text, at);
  return {};
}

}  // namespace stepwright::syntax
