#include "supervisor/translate/address.h"

#include <array>
#include <charconv>
#include <string>

namespace stepwright::translate {

namespace {

constexpr std::uint32_t kMaxBytes = 65'536;

struct Size {
  char letter;
  std::uint32_t bits;
};
constexpr std::array kSizes = {Size{'X', 1}, Size{'B', 8}, Size{'W', 16}, Size{'D', 32}, Size{'L', 64}};

struct SizedType {
  std::string_view name;
  char letter;
};
constexpr std::array kTypes = {SizedType{"BOOL", 'X'},  SizedType{"BYTE", 'B'},  SizedType{"SINT", 'B'},
                               SizedType{"USINT", 'B'}, SizedType{"INT", 'W'},   SizedType{"UINT", 'W'},
                               SizedType{"WORD", 'W'},  SizedType{"DINT", 'D'},  SizedType{"UDINT", 'D'},
                               SizedType{"DWORD", 'D'}, SizedType{"REAL", 'D'},  SizedType{"LINT", 'L'},
                               SizedType{"ULINT", 'L'}, SizedType{"LWORD", 'L'}, SizedType{"LREAL", 'L'}};

// The number at the front of `text`, which is shortened by it.
std::optional<std::uint32_t> take_number(std::string_view& text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value >= kMaxBytes) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

std::optional<Address> parse_address(std::string_view text) {
  if (text.size() < 3 || text[0] != '%') return std::nullopt;
  Address address;
  address.area = text[1];
  if (address.area != 'I' && address.area != 'Q' && address.area != 'M') return std::nullopt;
  text.remove_prefix(2);
  for (const Size& size : kSizes) {
    if (text[0] != size.letter) continue;
    address.size = size.letter;
    address.bits = size.bits;
    text.remove_prefix(1);
    break;
  }
  const auto number = take_number(text);
  if (!number) return std::nullopt;
  if (address.size != 'X') {
    address.first_bit = *number * address.bits;
    const bool inside = address.first_bit + address.bits <= kMaxBytes * 8;
    return text.empty() && inside ? std::optional(address) : std::nullopt;
  }
  if (text.empty() || text[0] != '.') return std::nullopt;
  text.remove_prefix(1);
  const auto bit = take_number(text);
  if (!bit || *bit > 7 || !text.empty()) return std::nullopt;
  address.first_bit = *number * 8 + *bit;
  return address;
}

bool overlap(const Address& a, const Address& b) {
  return a.area == b.area && a.first_bit < b.first_bit + b.bits && b.first_bit < a.first_bit + a.bits;
}

std::optional<char> address_size_of(std::string_view type) {
  for (const SizedType& known : kTypes) {
    if (known.name == type) return known.letter;
  }
  return std::nullopt;
}

}  // namespace stepwright::translate
