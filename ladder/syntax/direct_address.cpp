#include "ladder/syntax/direct_address.h"

namespace stepwright::syntax {

std::string to_string(const DirectAddress& address) {
  static constexpr char kAreas[] = {'I', 'Q', 'M'};
  std::string text = std::string("%") + kAreas[static_cast<std::size_t>(address.area)];
  if (address.bits == 1) return text + "X" + std::to_string(address.byte) + "." + std::to_string(address.bit);
  const char size = address.bits == 8 ? 'B' : address.bits == 16 ? 'W' : address.bits == 32 ? 'D' : 'L';
  return text + size + std::to_string(address.byte / (address.bits / 8u));
}

}  // namespace stepwright::syntax
