#pragma once

// Texts of files are UTF-8, as pages and documents are. Pure; any thread.
//
//   if (const auto broken = place_of_no_utf8("tags.csv", text)) report(*broken, "this byte is no UTF-8");

#include <optional>
#include <string>
#include <string_view>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::result {

// What some editors and spreadsheets write before a text, and it is none of.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

inline constexpr const char* kUtf8Hint =
    "save the file as UTF-8; spreadsheets call it \"CSV UTF-8\", and `iconv -f LATIN1 -t UTF-8` makes it of "
    "Latin-1";

// Line and column (characters) of the first byte that belongs to no character of UTF-8 (Unicode 15, table
// 3-7); nothing if all of it is UTF-8.
std::optional<Location> place_of_no_utf8(std::string file, std::string_view text);

}  // namespace stepwright::result
