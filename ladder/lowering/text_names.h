#pragma once

// Names in texts of ST that are shown, not compiled. Internal to this folder.

#include <cctype>
#include <string>
#include <string_view>

namespace stepwright::lowering {

// Calls `found(name)` for each word of a text, a name or a number; what it returns replaces it.
template <typename Found>
std::string each_name(std::string_view text, const Found& found) {
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_letter(text[end])) ++end;
    if (end == at) {
      result += text[at++];
      continue;
    }
    result += found(std::string(text.substr(at, end - at)));
    at = end;
  }
  return result;
}

// Name of a connector, for a wire that is not drawn through: where the line ends, and where it goes on (IEC
// 61131-3, 8.1.3).
inline std::string connector_name(std::size_t number) {
  return ">" + std::to_string(number) + ">";
}

}  // namespace stepwright::lowering
