#pragma once

// CRC-32C (Castagnoli), the sum of runtime/record, bit by bit: a table would be a kilobyte of flash.

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::app {

// Continued from `before`, the sum of what comes in front. crc32c of "123456789" is 0xE3069283.
constexpr std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0) {
  std::uint32_t crc = ~before;
  for (const std::byte byte : bytes) {
    crc ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0x82F63B78u & (0u - (crc & 1u)));
  }
  return ~crc;
}

}  // namespace stepwright::app
