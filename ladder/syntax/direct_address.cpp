#include "ladder/syntax/direct_address.h"

namespace stepwright::syntax {

std::optional<HierarchicalAddress> parse_hierarchical(std::string_view text) {
  if (text.size() < 4 || text[0] != '%') return std::nullopt;
  HierarchicalAddress result;
  const std::size_t area = std::string_view("IQM").find(naming::to_upper(text[1]));
  if (area == std::string_view::npos) return std::nullopt;
  result.address.area = static_cast<Area>(area);
  text.remove_prefix(2);
  for (const naming::internal::SizeLetter& size : naming::internal::kSizeLetters) {
    if (naming::to_upper(text[0]) != size.letter) continue;
    result.address.bits = size.bits;
    text.remove_prefix(1);
    break;
  }
  while (true) {
    const auto level = naming::internal::take_index(text);
    if (!level) return std::nullopt;
    result.levels.push_back(*level);
    if (text.empty()) break;
    if (text[0] != '.') return std::nullopt;
    text.remove_prefix(1);
  }
  const std::size_t least = result.address.bits == 1 ? 3 : 2;
  return result.levels.size() < least ? std::nullopt : std::optional(result);
}

std::string to_string(const DirectAddress& address) {
  static constexpr char kAreas[] = {'I', 'Q', 'M'};
  std::string text = std::string("%") + kAreas[static_cast<std::size_t>(address.area)];
  if (address.bits == 1) return text + "X" + std::to_string(address.byte) + "." + std::to_string(address.bit);
  const char size = address.bits == 8 ? 'B' : address.bits == 16 ? 'W' : address.bits == 32 ? 'D' : 'L';
  return text + size + std::to_string(address.byte / (address.bits / 8u));
}

}  // namespace stepwright::syntax
