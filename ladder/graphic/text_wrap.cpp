#include "ladder/graphic/text_wrap.h"

#include <cassert>

#include "ladder/graphic/sfc_layout.h"

namespace stepwright::graphic {
namespace {

bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// Bytes of the first `count` characters.
std::size_t bytes_of(const std::string& text, std::size_t count) {
  std::size_t end = 0;
  while (end < text.size() && count > 0) {
    ++end;
    while (end < text.size() && continues(text[end])) ++end;
    --count;
  }
  return end;
}

}  // namespace

std::vector<std::string> wrap_characters(const std::string& text, std::size_t width) {
  assert(width > 0);
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = begin + bytes_of(text.substr(begin, 4 * width), width);
    lines.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  if (lines.empty()) lines.emplace_back();
  return lines;
}

std::vector<std::string> wrap_words(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  std::size_t used = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find_first_of(" \t\r\n", begin);
    const std::string word = text.substr(begin, end == std::string::npos ? end : end - begin);
    begin = end == std::string::npos ? text.size() : end + 1;
    if (word.empty()) continue;
    for (const std::string& piece : wrap_characters(word, width)) {
      const std::size_t length = length_of(piece);
      if (used > 0 && used + 1 + length > width) {
        lines.emplace_back();
        used = 0;
      }
      lines.back() += (used > 0 ? " " : "") + piece;
      used += length + (used > 0 ? 1 : 0);
    }
  }
  return lines;
}

std::string shortened(const std::string& text, std::size_t width) {
  if (length_of(text) <= width) return text;
  return width == 0 ? "" : text.substr(0, bytes_of(text, width - 1)) + "…";
}

}  // namespace stepwright::graphic
