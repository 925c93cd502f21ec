#pragma once

// CRC-32C (Castagnoli), as iSCSI (RFC 3720, appendix B.4) and ext4 use it: finds every burst of up to 32
// wrong bits. One definition, two speeds: with a table of a kilobyte, and bit by bit where a kilobyte of
// flash counts more than time.
//
// Threads: any. No heap, no OS.
//
//   crc32c(bytes);                            // 0xE3069283 of the text "123456789"
//   crc32c(behind, crc32c(in_front));         // of both, one behind the other

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::base {

// The sum after eight more bits, which have been combined with its lowest byte: the definition of both
// speeds.
constexpr std::uint32_t crc32c_shifted(std::uint32_t crc) {
  constexpr std::uint32_t kPolynomial = 0x82F63B78;  // 0x1EDC6F41 with its bits reflected
  for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (kPolynomial & (0u - (crc & 1u)));
  return crc;
}

// Continued from `before`, the sum of what comes in front. Bit by bit: no table.
constexpr std::uint32_t crc32c_bitwise(std::span<const std::byte> bytes, std::uint32_t before = 0) {
  std::uint32_t crc = ~before;
  for (const std::byte byte : bytes) crc = crc32c_shifted(crc ^ std::to_integer<std::uint32_t>(byte));
  return ~crc;
}

inline constexpr auto kCrc32cTable = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) table[byte] = crc32c_shifted(byte);
  return table;
}();

// The same sum, a byte at a time.
constexpr std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0) {
  std::uint32_t crc = ~before;
  for (const std::byte byte : bytes)
    crc = crc >> 8 ^ kCrc32cTable[(crc ^ std::to_integer<std::uint32_t>(byte)) & 0xFF];
  return ~crc;
}

}  // namespace stepwright::base
