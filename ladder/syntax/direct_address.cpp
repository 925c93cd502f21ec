#include "ladder/syntax/direct_address.h"

#include "ladder/syntax/number.h"
#include "runtime/base/ascii_names.h"

namespace stepwright::syntax {

namespace {

using base::to_upper;

std::optional<Area> area_of(char letter) {
  switch (letter) {
    case 'I':
      return Area::Input;
    case 'Q':
      return Area::Output;
    case 'M':
      return Area::Marker;
    default:
      return std::nullopt;
  }
}

// Bits of a size letter; 0 for any other character.
std::uint8_t bits_of(char letter) {
  switch (letter) {
    case 'X':
      return 1;
    case 'B':
      return 8;
    case 'W':
      return 16;
    case 'D':
      return 32;
    case 'L':
      return 64;
    default:
      return 0;
  }
}

}  // namespace

std::optional<DirectAddress> parse_address(std::string_view text) {
  if (text.size() < 3 || text[0] != '%') return std::nullopt;
  const auto area = area_of(to_upper(text[1]));
  if (!area) return std::nullopt;
  text.remove_prefix(2);
  DirectAddress address;
  address.area = *area;
  if (const std::uint8_t bits = bits_of(to_upper(text[0])); bits != 0) {
    address.bits = bits;
    text.remove_prefix(1);
  }
  const std::size_t dot = text.find('.');
  const auto number = parse_integer(text.substr(0, dot), 10);
  if (!number || *number >= kAreaLimit) return std::nullopt;
  if (address.bits == 1) {
    if (dot == std::string_view::npos) return std::nullopt;
    const auto bit = parse_integer(text.substr(dot + 1), 10);
    if (!bit || *bit > 7) return std::nullopt;
    address.bit = static_cast<std::uint8_t>(*bit);
  } else if (dot != std::string_view::npos) {
    return std::nullopt;
  }
  const std::uint64_t bytes = address.bits == 1 ? 1 : address.bits / 8;
  if (*number * bytes + bytes > kAreaLimit) return std::nullopt;
  address.byte = static_cast<std::uint32_t>(*number * bytes);
  return address;
}

std::string to_string(const DirectAddress& address) {
  static constexpr char kAreas[] = {'I', 'Q', 'M'};
  std::string text = std::string("%") + kAreas[static_cast<std::size_t>(address.area)];
  if (address.bits == 1) return text + "X" + std::to_string(address.byte) + "." + std::to_string(address.bit);
  const char size = address.bits == 8 ? 'B' : address.bits == 16 ? 'W' : address.bits == 32 ? 'D' : 'L';
  return text + size + std::to_string(address.byte / (address.bits / 8u));
}

}  // namespace stepwright::syntax
