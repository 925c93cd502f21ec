#include "hmi_web/drawing/pictures.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string>

namespace stepwright::drawing {
namespace {

constexpr std::array<std::string_view, 3> kHeads = {"data:image/png;base64,", "data:image/jpeg;base64,",
                                                    "data:image/webp;base64,"};

// -1: none of the 64.
int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

// Up to the first "=".
std::string decoded(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    const int value = value_of(c);
    if (value < 0) continue;  // blanks
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

// Its own length stands at its front (RIFF, little-endian).
bool is_whole_webp(std::string_view bytes) {
  if (bytes.size() < 12 || !bytes.starts_with("RIFF") || bytes.substr(8, 4) != "WEBP") return false;
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length |= std::uint32_t{static_cast<unsigned char>(bytes[4 + i])} << 8 * i;
  return length <= bytes.size() - 8;
}

}  // namespace

bool is_embedded_picture(std::string_view value) {
  for (const std::string_view head : kHeads) {
    if (!value.starts_with(head)) continue;
    value.remove_prefix(head.size());
    return std::all_of(value.begin(), value.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '/' || c == '=' ||
             c == '\n' || c == ' ';
    });
  }
  return false;
}

bool is_whole_picture(std::string_view value) {
  const std::string bytes = decoded(value.substr(std::min(value.find(',') + 1, value.size())));
  if (bytes.starts_with("\x89PNG\r\n\x1A\n")) return bytes.find("IEND") != std::string::npos;
  if (bytes.starts_with("\xFF\xD8\xFF")) return bytes.rfind("\xFF\xD9") != std::string::npos;
  return is_whole_webp(bytes);
}

}  // namespace stepwright::drawing
