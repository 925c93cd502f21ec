#include "plant_models/bridge/io_address.h"

#include <optional>

#include "runtime/ground/naming/direct_address.h"

namespace stepwright::bridge {
namespace {

std::optional<IoWidth> width_of(std::uint8_t bits) {
  for (const IoWidth width : {IoWidth::Bit, IoWidth::Byte, IoWidth::Word, IoWidth::DoubleWord}) {
    if (IoAddress{.width = width}.size_bits() == bits) return width;
  }
  return std::nullopt;
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
  const auto address = naming::parse_direct_address(text);
  const auto width = address ? width_of(address->bits) : std::nullopt;
  if (width && address->area != naming::Area::Marker) {
    const IoArea area = address->area == naming::Area::Input ? IoArea::Input : IoArea::Output;
    return IoAddress{area, *width, address->byte, address->bit};
  }
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
