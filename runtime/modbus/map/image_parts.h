#pragma once

// Bytes of a write, gathered into the parts of a BlockWrite: neighbours go into one part.

#include "runtime/modbus/map/register_map.h"

namespace stepwright::modbus::map {

// The bits of `mask` in the byte at `address` take those of `value`. Later bits win over earlier ones of the
// same byte.
inline void add_byte(Parts& parts, std::uint32_t address, std::uint8_t mask, std::uint8_t value) {
  if (mask == 0) return;
  // Parts begin at multiples of eight, so that it does not matter in which order the bytes of a value come.
  const std::uint32_t begin = address & ~7u;
  const std::uint32_t shift = address % 8 * 8;
  const std::uint64_t bits = std::uint64_t{mask} << shift;
  if (parts.empty() || parts.back().byte_offset != begin) parts.push_back({begin, 0, 0});
  host::ImageBits& last = parts.back();
  last.mask |= bits;
  last.value = (last.value & ~bits) | (std::uint64_t{value} << shift & bits);
}

}  // namespace stepwright::modbus::map
