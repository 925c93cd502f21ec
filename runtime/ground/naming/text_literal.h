#pragma once

// The characters of string literals (IEC 61131-3, 6.3.3, tables 5 and 6). Pure; any thread.
//
//   parse_text("a$N", TextWidth::Single, mistake)   // u"a\n"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::naming {

// Single: characters are ISO 10646 row 00 (Latin-1), $hh; Double: UTF-16 code units, $hhhh.
enum class TextWidth : unsigned char { Single, Double };

struct TextMistake {
  std::size_t offset = 0;  // into the text between the quotes
  const char* message = "";
};

// The characters between the quotes. Sources are UTF-8; a byte that is no UTF-8 stands for itself, as in
// sources written in Latin-1. Nothing on a wrong `$` combination or, in a Single text, on a character beyond
// 255; `mistake` says where then.
std::optional<std::u16string> parse_text(std::string_view inside, TextWidth width, TextMistake& mistake);

// The other way, for terminals: `text` (UTF-8) with control characters as literals write them ($N, $1B; $001B
// in a Double one) and `$` as `$$`. So a text is one line, and acts on nothing.
std::string literal_text(std::string_view text, TextWidth width);

}  // namespace stepwright::naming
