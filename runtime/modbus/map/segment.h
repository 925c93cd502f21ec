#pragma once

#include <cstdint>

#include "runtime/modbus/map/map_config.h"
#include "runtime/modbus/map/table.h"

namespace stepwright::modbus::map {

// Kind of the values at an address of a table.
enum class Kind : std::uint8_t {
  Zero,   // nothing: reads 0
  Bits,   // bits of the image that follow each other
  Bools,  // BOOLs of a byte each
  Byte,   // values of 1, 2, 4 or 8 bytes
  Word,
  Dword,
  Lword,
};

// Addresses that follow each other and stand for values that follow each other in the image.
struct Segment {
  std::uint32_t first = 0;    // address in the table
  std::uint32_t count = 0;    // addresses
  std::uint32_t address = 0;  // byte of the image
  Kind kind = Kind::Zero;
  std::uint8_t bit = 0;    // of the first one, if the kind is Bits
  bool is_signed = false;  // of bytes in registers: how they are widened
  bool writable = false;
  Order byte_order = Order::HighFirst;
  Order word_order = Order::HighFirst;

  std::uint32_t end() const { return first + count; }
};

// Of one value: bytes in the image, addresses in a table of registers.
constexpr std::uint32_t bytes_of(Kind kind) {
  switch (kind) {
    case Kind::Word:
      return 2;
    case Kind::Dword:
      return 4;
    case Kind::Lword:
      return 8;
    default:
      return 1;
  }
}
constexpr std::uint32_t registers_of(Kind kind) {
  return bytes_of(kind) < 2 ? 1 : bytes_of(kind) / 2;
}

}  // namespace stepwright::modbus::map
