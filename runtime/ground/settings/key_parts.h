#pragma once

// Depth of the keys of a TOML text, found before it is parsed: each part of a dotted key or of a table's name
// is a table within a table, and whoever parses, compares or frees them goes down as deep as they are nested.
//
//   if (auto deep = too_deep_key(text)) ...   // its place
//
// A pure function; any thread.

#include <cstdint>
#include <optional>
#include <string_view>

namespace stepwright::settings {

// Parts of a key, as in `a.b.c`: three. Arrays and inline tables have a limit of their own in the parser.
inline constexpr std::uint32_t kMostKeyParts = 64;

struct KeyPlace {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

// Where the first key with more than kMostKeyParts parts is; strings and comments are none.
std::optional<KeyPlace> too_deep_key(std::string_view text);

}  // namespace stepwright::settings
