#include "runtime/ground/settings/key_parts.h"

#include <cstddef>

namespace stepwright::settings {
namespace {

// Where the string that begins at `begin` has ended: behind its last quote, or at the end of the text.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
  const bool many_lines = text.substr(begin, 3) == three;
  for (std::size_t i = begin + (many_lines ? 3 : 1); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (many_lines) {
      if (text.substr(i, 3) == three) return i + 3;
    } else if (text[i] == quote || text[i] == '\n') {
      return i + 1;
    }
  }
  return text.size();
}

KeyPlace place_of(std::string_view text, std::size_t at) {
  KeyPlace place;
  for (std::size_t i = 0; i < at; ++i) {
    place.column = text[i] == '\n' ? 1 : place.column + 1;
    place.line += text[i] == '\n' ? 1 : 0;
  }
  return place;
}

// What may stand between the dots of a key, and around them.
bool belongs_to_key(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ' ' || c == '\t';
}

}  // namespace

std::optional<KeyPlace> too_deep_key(std::string_view text) {
  std::uint32_t parts = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (c == '#') {
      i = text.find('\n', i);
      if (i == std::string_view::npos) break;
      continue;
    }
    if (c == '.') {
      if (++parts > kMostKeyParts) return place_of(text, i);
    } else if (!belongs_to_key(c)) {
      parts = 1;
    }
    ++i;
  }
  return std::nullopt;
}

}  // namespace stepwright::settings
