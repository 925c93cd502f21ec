#pragma once

// Numbers of 16 bits on the wire: the most significant byte first (Modbus Application Protocol V1.1b3, 4.2).

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::modbus::pdu {

// Requires at + 2 <= bytes.size().
constexpr std::uint16_t get16(std::span<const std::byte> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(std::to_integer<unsigned>(bytes[at]) << 8 |
                                    std::to_integer<unsigned>(bytes[at + 1]));
}
constexpr void put16(std::span<std::byte> bytes, std::size_t at, std::uint16_t value) {
  bytes[at] = static_cast<std::byte>(value >> 8);
  bytes[at + 1] = static_cast<std::byte>(value & 0xFF);
}

}  // namespace stepwright::modbus::pdu
