#include "supervisor/translate/address.h"

#include <array>
#include <cstddef>

#include "runtime/ground/naming/direct_address.h"

namespace stepwright::translate {

namespace {

struct SizedType {
  std::string_view name;
  char letter;
};
constexpr std::array kTypes = {SizedType{"BOOL", 'X'},  SizedType{"BYTE", 'B'},  SizedType{"SINT", 'B'},
                               SizedType{"USINT", 'B'}, SizedType{"INT", 'W'},   SizedType{"UINT", 'W'},
                               SizedType{"WORD", 'W'},  SizedType{"DINT", 'D'},  SizedType{"UDINT", 'D'},
                               SizedType{"DWORD", 'D'}, SizedType{"REAL", 'D'},  SizedType{"LINT", 'L'},
                               SizedType{"ULINT", 'L'}, SizedType{"LWORD", 'L'}, SizedType{"LREAL", 'L'}};

}  // namespace

std::optional<Address> parse_address(std::string_view text) {
  const auto found = naming::parse_direct_address(text);
  if (!found) return std::nullopt;
  const char area = "IQM"[static_cast<std::size_t>(found->area)];
  const char size = found->bits == 1    ? 'X'
                    : found->bits == 8  ? 'B'
                    : found->bits == 16 ? 'W'
                    : found->bits == 32 ? 'D'
                                        : 'L';
  return Address{area, size, found->byte * 8 + found->bit, found->bits};
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
