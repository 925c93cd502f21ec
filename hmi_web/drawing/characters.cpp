#include "hmi_web/drawing/characters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>

#include "runtime/ground/markup/xml_scan.h"

namespace stepwright::drawing {
namespace {

bool is_soft_break(std::uint32_t code) {
  return code == 0x0B || code == 0x03;
}

bool is_character(std::uint32_t code) {
  return code == '\t' || code == '\n' || code == '\r' || is_soft_break(code) ||
         (code >= 0x20 && code < 0xD800) || (code > 0xDFFF && code < 0xFFFE) ||
         (code > 0xFFFF && code <= 0x10FFFF);
}

// "amp", "#176", "#xB0".
bool is_known_entity(std::string_view name) {
  constexpr std::array<std::string_view, 5> kKnown = {"amp", "lt", "gt", "quot", "apos"};
  if (std::ranges::find(kKnown, name) != kKnown.end()) return true;
  if (!name.starts_with('#')) return false;
  const bool hexadecimal = name.starts_with("#x");
  name.remove_prefix(hexadecimal ? 2 : 1);
  std::uint32_t code = 0;
  const auto read = std::from_chars(name.data(), name.data() + name.size(), code, hexadecimal ? 16 : 10);
  return read.ec == std::errc() && read.ptr == name.data() + name.size() && is_character(code);
}

// U+FFFE and U+FFFF, which are characters of UTF-8, but of no text.
bool is_at_noncharacter(std::string_view rest) {
  return rest.starts_with("\xEF\xBF\xBE") || rest.starts_with("\xEF\xBF\xBF");
}

}  // namespace

std::optional<std::size_t> place_of_control(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto byte = static_cast<unsigned char>(text[at]);
    if (!is_character(byte) || (byte == 0xEF && is_at_noncharacter(text.substr(at)))) return at;
  }
  return std::nullopt;
}

std::optional<std::size_t> place_of_unknown_entity(std::string_view text) {
  for (std::size_t at = text.find_first_of("&<"); at < text.size(); at = text.find_first_of("&<", at)) {
    if (text[at] == '<') {
      const std::size_t end = markup::end_of_plain(text, at);
      at = std::max(end, at + 1);
      continue;
    }
    const std::size_t end = text.find_first_of(";<&", at + 1);
    if (end == std::string_view::npos || text[end] != ';') return at;
    if (!is_known_entity(text.substr(at + 1, end - at - 1))) return at;
    at = end;
  }
  return std::nullopt;
}

std::string text_of_no_character(std::string_view text, std::size_t at) {
  if (text[at] == '&')
    return std::string(text.substr(at, std::min<std::size_t>(10, text.find_first_of(";<\n", at) - at)));
  const bool is_control = static_cast<unsigned char>(text[at]) < 0x20;
  std::array<char, 8> room{};
  std::snprintf(room.data(), room.size(), "U+%04X",
                is_control ? static_cast<unsigned>(text[at]) : (text[at + 2] == '\xBE' ? 0xFFFEU : 0xFFFFU));
  return room.data();
}

std::string with_line_ends(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return is_soft_break(static_cast<unsigned char>(c)); }, '\n');
  return text;
}

}  // namespace stepwright::drawing
