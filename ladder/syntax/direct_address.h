#pragma once

// Directly represented variables (IEC 61131-3, 6.5.5): %IX0.0, %QB3, %MW12. Words do not count in words of
// their own size only: %IW1 are the bytes 2 and 3, so that areas of different sizes overlap (as in CODESYS).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::syntax {

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

// Nothing if the text is no address: unknown area or size, bit above 7, missing number, too large.
std::optional<DirectAddress> parse_address(std::string_view text);
// "%IX0.0"
std::string to_string(const DirectAddress& address);

}  // namespace stepwright::syntax
