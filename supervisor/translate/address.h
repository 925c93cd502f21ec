#pragma once

// Located addresses of IEC 61131-3 ("%IX0.2", "%QW4"). Areas are byte-addressed and overlap: %IW1 is bytes 2
// and 3, %IX2.0 bit 0 of byte 2.

#include <cstdint>
#include <optional>
#include <string_view>

namespace stepwright::translate {

struct Address {
  char area = 'I';  // I, Q or M
  char size = 'X';  // X, B, W, D or L
  std::uint32_t first_bit = 0;
  std::uint32_t bits = 1;
};

// Nullopt if `text` is no address, has a bit number above 7 or lies above 64 KiB.
std::optional<Address> parse_address(std::string_view text);
bool overlap(const Address& a, const Address& b);
// The size letter that a variable of this elementary type needs; nullopt for other types.
std::optional<char> address_size_of(std::string_view type);

}  // namespace stepwright::translate
