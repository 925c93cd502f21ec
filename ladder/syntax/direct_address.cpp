#include "ladder/syntax/direct_address.h"

#include <algorithm>
#include <iterator>

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

std::optional<RelativeAddress> parse_relative(std::string_view text, std::uint32_t limit) {
  if (text.size() < 3 || text[0] != '%') return std::nullopt;
  RelativeAddress result;
  const auto size = std::ranges::find(naming::internal::kSizeLetters, naming::to_upper(text[1]),
                                      &naming::internal::SizeLetter::letter);
  if (size == std::end(naming::internal::kSizeLetters)) return std::nullopt;
  result.bits = size->bits;
  text.remove_prefix(2);
  const auto byte = naming::internal::take_index(text, limit);
  if (!byte) return std::nullopt;
  result.byte = *byte;
  if (result.bits == 1) {
    if (text.empty() || text[0] != '.') return std::nullopt;
    text.remove_prefix(1);
    const auto bit = naming::internal::take_index(text, 8);
    if (!bit) return std::nullopt;
    result.bit = static_cast<std::uint8_t>(*bit);
  }
  return text.empty() ? std::optional(result) : std::nullopt;
}

std::string to_string(const RelativeAddress& address) {
  const auto size =
      std::ranges::find(naming::internal::kSizeLetters, address.bits, &naming::internal::SizeLetter::bits);
  std::string text = std::string("%") + size->letter + std::to_string(address.byte);
  return address.bits == 1 ? text + "." + std::to_string(address.bit) : text;
}

std::string to_string(const DirectAddress& address) {
  static constexpr char kAreas[] = {'I', 'Q', 'M'};
  std::string text = std::string("%") + kAreas[static_cast<std::size_t>(address.area)];
  if (address.bits == 1) return text + "X" + std::to_string(address.byte) + "." + std::to_string(address.bit);
  const char size = address.bits == 8 ? 'B' : address.bits == 16 ? 'W' : address.bits == 32 ? 'D' : 'L';
  return text + size + std::to_string(address.byte / (address.bits / 8u));
}

}  // namespace stepwright::syntax
