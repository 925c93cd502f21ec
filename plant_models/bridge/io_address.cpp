#include "plant_models/bridge/io_address.h"

#include <charconv>
#include <optional>
#include <utility>

#include "runtime/base/ascii_names.h"

namespace stepwright::bridge {
namespace {

// Far above any image, far below an overflow of byte * 8.
constexpr std::uint32_t kMaxIndex = 1'000'000;

// Takes a decimal number off the front of `text`.
std::optional<std::uint32_t> take_number(std::string_view& text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value > kMaxIndex) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool take(std::string_view& text, char wanted) {
  if (text.empty() || base::to_upper(text.front()) != wanted) return false;
  text.remove_prefix(1);
  return true;
}

std::optional<IoAddress> parse(std::string_view text) {
  IoAddress address;
  if (!take(text, '%')) return std::nullopt;
  if (take(text, 'Q')) {
    address.area = IoArea::Output;
  } else if (!take(text, 'I')) {
    return std::nullopt;
  }
  constexpr std::pair<char, IoWidth> kWidths[] = {
      {'X', IoWidth::Bit}, {'B', IoWidth::Byte}, {'W', IoWidth::Word}, {'D', IoWidth::DoubleWord}};
  for (const auto& [letter, width] : kWidths) {
    if (!take(text, letter)) continue;
    address.width = width;
    break;
  }
  const auto index = take_number(text);
  if (!index) return std::nullopt;
  if (address.width == IoWidth::Bit) {
    address.byte = *index;
    if (!take(text, '.')) return std::nullopt;
    const auto bit = take_number(text);
    if (!bit || *bit > 7) return std::nullopt;
    address.bit = static_cast<std::uint8_t>(*bit);
  } else {
    address.byte = *index * (address.size_bits() / 8);
  }
  return text.empty() ? std::optional(address) : std::nullopt;
}

}  // namespace

std::uint32_t IoAddress::size_bits() const {
  switch (width) {
    case IoWidth::Bit:
      return 1;
    case IoWidth::Byte:
      return 8;
    case IoWidth::Word:
      return 16;
    case IoWidth::DoubleWord:
      return 32;
  }
  return 0;
}

result::Result<IoAddress> parse_io_address(std::string_view text, const result::Location& where) {
  if (const auto address = parse(text)) return *address;
  return result::fail("C0302", where, "'" + std::string(text) + "' is no input or output address",
                      "write %IX0.0 or %QX0.0 for a bit (bit 0..7), %IW1 for a word");
}

std::string to_string(const IoAddress& address) {
  std::string text = address.area == IoArea::Input ? "%I" : "%Q";
  constexpr char kLetters[] = {'X', 'B', 'W', 'D'};
  text += kLetters[static_cast<std::size_t>(address.width)];
  if (address.width == IoWidth::Bit) {
    return text + std::to_string(address.byte) + "." + std::to_string(address.bit);
  }
  return text + std::to_string(address.byte * 8 / address.size_bits());
}

}  // namespace stepwright::bridge
