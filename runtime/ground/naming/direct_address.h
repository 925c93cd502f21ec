#pragma once

// Directly represented variables (IEC 61131-3, 6.5.5) as text: "%IX0.0", "%QB3", "%MW12". Words count in
// words of their own size: %IW1 is the bytes 2 and 3, so that addresses of different sizes overlap (as in
// CODESYS). One number of a bit counts in bits: %QX75 is %QX9.3. Pure; no heap.
//
//   parse_direct_address("%IW1")  ->  {Area::Input, .bits = 16, .byte = 2}

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::naming {

enum class Area : std::uint8_t { Input, Output, Marker };

struct DirectAddress {
  Area area = Area::Input;
  std::uint8_t bits = 1;   // 1, 8, 16, 32 or 64
  std::uint32_t byte = 0;  // offset into the area
  std::uint8_t bit = 0;    // of `byte`; 0 unless bits = 1

  friend bool operator==(const DirectAddress&, const DirectAddress&) = default;
};

// Areas end at 64 KiB: nothing beyond is an address.
inline constexpr std::uint32_t kAreaLimit = 65536;

namespace internal {

struct SizeLetter {
  char letter;
  std::uint8_t bits;
};
inline constexpr SizeLetter kSizeLetters[] = {{'X', 1}, {'B', 8}, {'W', 16}, {'D', 32}, {'L', 64}};

// Takes a decimal number below `limit` off the front of `text`; single underscores may divide its digits.
constexpr std::optional<std::uint32_t> take_index(std::string_view& text, std::uint32_t limit = kAreaLimit) {
  const auto is_digit = [&text](std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
  };
  if (!is_digit(0)) return std::nullopt;
  std::uint32_t value = 0;
  std::size_t at = 0;
  while (is_digit(at)) {
    value = value * 10 + static_cast<std::uint32_t>(text[at] - '0');
    if (value >= limit) return std::nullopt;
    ++at;
    if (at < text.size() && text[at] == '_' && is_digit(at + 1)) ++at;
  }
  text.remove_prefix(at);
  return value;
}

}  // namespace internal

// Upper and lower case are one; without a size letter the address is one of a bit. Nothing if the text is no
// address: unknown area or size, bit above 7, missing number, beyond the area.
constexpr std::optional<DirectAddress> parse_direct_address(std::string_view text) {
  if (text.size() < 3 || text[0] != '%') return std::nullopt;
  DirectAddress address;
  const std::size_t area = std::string_view("IQM").find(to_upper(text[1]));
  if (area == std::string_view::npos) return std::nullopt;
  address.area = static_cast<Area>(area);
  text.remove_prefix(2);
  for (const internal::SizeLetter& size : internal::kSizeLetters) {
    if (to_upper(text[0]) != size.letter) continue;
    address.bits = size.bits;
    text.remove_prefix(1);
    break;
  }
  const bool is_bit = address.bits == 1;
  const auto index = internal::take_index(text, is_bit ? kAreaLimit * 8 : kAreaLimit);
  if (!index) return std::nullopt;
  if (is_bit && text.empty()) {
    address.byte = *index / 8;
    address.bit = static_cast<std::uint8_t>(*index % 8);
    return address;
  }
  if (is_bit) {
    if (text[0] != '.') return std::nullopt;
    text.remove_prefix(1);
    const auto bit = internal::take_index(text);
    if (!bit || *bit > 7) return std::nullopt;
    address.bit = static_cast<std::uint8_t>(*bit);
  }
  const std::uint32_t bytes = is_bit ? 1 : address.bits / 8u;
  if (!text.empty() || (*index + 1) * bytes > kAreaLimit) return std::nullopt;
  address.byte = *index * bytes;
  return address;
}

}  // namespace stepwright::naming
