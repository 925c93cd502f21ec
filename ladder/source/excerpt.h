#pragma once

// A line of a source and a caret below one of its characters. Internal to this folder.
//
// Columns on the screen are not characters: characters of East Asia take two, combining ones none, tabs go to
// the next stop. What a terminal would obey instead of showing it becomes '?'.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stepwright::source {

struct Excerpt {
  std::string line;    // at most `width` columns and the dots where it was cut
  std::string indent;  // white space up to below the character
};

// `column` counts characters from 1; behind the end of the line the caret stands behind its last character.
Excerpt excerpt(std::string_view line, std::uint32_t column, std::size_t width);

}  // namespace stepwright::source
