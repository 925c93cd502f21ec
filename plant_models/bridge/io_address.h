#pragma once

// Addresses of directly represented variables as text (IEC 61131-3, 2.4.1.1): "%IX0.3", "%QW2", and what
// they occupy of an I/O area. Words overlap bytes as runtime/image/io_driver.h says: %IW1 is bytes 2 and 3.

#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"

namespace stepwright::bridge {

enum class IoArea : std::uint8_t { Input, Output };
enum class IoWidth : std::uint8_t { Bit, Byte, Word, DoubleWord };

struct IoAddress {
  IoArea area = IoArea::Input;
  IoWidth width = IoWidth::Bit;
  std::uint32_t byte = 0;  // first byte in the area
  std::uint8_t bit = 0;    // 0..7, of a Bit

  std::uint32_t size_bits() const;
  std::uint32_t first_bit() const { return byte * 8 + bit; }

  friend bool operator==(const IoAddress&, const IoAddress&) = default;
};

// Reads "%IX0.3"; upper and lower case alike, the X may be missing. Fails with C0302 at `where`.
[[nodiscard]] result::Result<IoAddress> parse_io_address(std::string_view text,
                                                         const result::Location& where);

std::string to_string(const IoAddress& address);

}  // namespace stepwright::bridge
