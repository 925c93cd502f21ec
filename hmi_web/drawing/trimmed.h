#pragma once

// Text without blanks at its ends. Pure. Internal to this folder.

#include <string_view>

namespace stepwright::drawing {

// Blanks are those of ASCII, with its control characters.
inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

}  // namespace stepwright::drawing
