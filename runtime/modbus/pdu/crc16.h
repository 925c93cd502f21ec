#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::modbus::pdu {

// The checksum of RTU frames: CRC-16 with polynomial 0xA001 (reflected), initial value 0xFFFF (Modbus over
// Serial Line V1.02, 6.2.2). On the line the low byte comes first.
std::uint16_t crc16(std::span<const std::byte> bytes);

// The same byte by byte. Over a frame with its checksum the result is 0.
inline constexpr std::uint16_t kCrcBegin = 0xFFFF;
std::uint16_t crc16_add(std::uint16_t crc, std::byte byte);

}  // namespace stepwright::modbus::pdu
