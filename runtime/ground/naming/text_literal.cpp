#include "runtime/ground/naming/text_literal.h"

#include <charconv>
#include <cstdint>

namespace stepwright::naming {

namespace {

// Takes one UTF-8 character off the front; an ill-formed byte is taken as it is.
char32_t take_character(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t more = first >= 0xF0 && first < 0xF5   ? 3
                           : first >= 0xE0 && first < 0xF0 ? 2
                           : first >= 0xC2 && first < 0xE0 ? 1
                                                           : 0;
  char32_t value = more == 3 ? first & 0x07u : more == 2 ? first & 0x0Fu : more == 1 ? first & 0x1Fu : first;
  std::size_t taken = 1;
  for (; taken <= more && taken < text.size() && (byte(taken) & 0xC0u) == 0x80u; ++taken)
    value = (value << 6) | (byte(taken) & 0x3Fu);
  if (taken != more + 1) {
    text.remove_prefix(1);
    return first;
  }
  text.remove_prefix(taken);
  return value;
}

void append(std::u16string& out, char32_t character) {
  if (character < 0x10000) {
    out += static_cast<char16_t>(character);
    return;
  }
  character -= 0x10000;
  out += static_cast<char16_t>(0xD800 + (character >> 10));
  out += static_cast<char16_t>(0xDC00 + (character & 0x3FF));
}

// What `$` and this letter stand for; 0 if they stand for nothing.
char16_t control(char letter, TextWidth width) {
  switch (letter) {
    case 'L':
    case 'l':
    case 'N':
    case 'n':
      return 0x0A;
    case 'P':
    case 'p':
      return 0x0C;
    case 'R':
    case 'r':
      return 0x0D;
    case 'T':
    case 't':
      return 0x09;
    case '$':
      return '$';
    case '\'':
      return width == TextWidth::Single ? u'\'' : u'\0';
    case '"':
      return width == TextWidth::Double ? u'"' : u'\0';
    default:
      return 0;
  }
}

// `$` was taken already. False if what follows means nothing.
bool take_escape(std::string_view& text, TextWidth width, std::u16string& out) {
  if (text.empty()) return false;
  if (const char16_t meant = control(text.front(), width)) {
    out += meant;
    text.remove_prefix(1);
    return true;
  }
  const std::size_t digits = width == TextWidth::Single ? 2 : 4;
  const std::string_view code = text.substr(0, digits);
  std::uint16_t value = 0;
  const auto read = std::from_chars(code.data(), code.data() + code.size(), value, 16);
  if (code.size() < digits || read.ptr != code.data() + digits) return false;
  out += static_cast<char16_t>(value);
  text.remove_prefix(digits);
  return true;
}

// Of a control character (C0, DEL, C1); empty: it is none.
std::string escape_of(char32_t character, TextWidth width) {
  switch (character) {
    case U'\n':
      return "$N";
    case U'\r':
      return "$R";
    case U'\t':
      return "$T";
    case U'\f':
      return "$P";
    default:
      break;
  }
  if (character >= 0x20 && (character < 0x7F || character > 0x9F)) return {};
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  return (width == TextWidth::Single ? "$" : "$00") + std::string(1, kDigits[character >> 4]) +
         kDigits[character & 0xF];
}

}  // namespace

std::string literal_text(std::string_view text, TextWidth width) {
  std::string out;
  while (!text.empty()) {
    const std::string_view before = text;
    const char32_t character = take_character(text);
    const std::string escape = character == U'$' ? "$$" : escape_of(character, width);
    out += escape.empty() ? before.substr(0, before.size() - text.size()) : escape;
  }
  return out;
}

std::optional<std::u16string> parse_text(std::string_view inside, TextWidth width, TextMistake& mistake) {
  std::u16string out;
  std::string_view rest = inside;
  while (!rest.empty()) {
    mistake.offset = inside.size() - rest.size();
    if (rest.front() == '$') {
      rest.remove_prefix(1);
      if (take_escape(rest, width, out)) continue;
      mistake.message = "'$' and what follows it stand for no character";
      return std::nullopt;
    }
    const char32_t character = take_character(rest);
    if (width == TextWidth::Single && character > 0xFF) {
      mistake.message = "the character does not fit into a STRING";
      return std::nullopt;
    }
    append(out, character);
  }
  return out;
}

}  // namespace stepwright::naming
