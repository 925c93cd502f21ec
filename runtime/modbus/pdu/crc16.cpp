#include "runtime/modbus/pdu/crc16.h"

#include <array>

namespace stepwright::modbus::pdu {
namespace {

// Half a byte at a time: 32 bytes of table instead of 512, for the flash of a small controller.
constexpr std::array<std::uint16_t, 16> make_table() {
  std::array<std::uint16_t, 16> table{};
  for (std::uint16_t i = 0; i < table.size(); ++i) {
    std::uint16_t value = i;
    for (int bit = 0; bit < 4; ++bit)
      value = static_cast<std::uint16_t>((value & 1) != 0 ? (value >> 1) ^ 0xA001 : value >> 1);
    table[i] = value;
  }
  return table;
}

constexpr std::array<std::uint16_t, 16> kTable = make_table();

}  // namespace

std::uint16_t crc16_add(std::uint16_t crc, std::byte byte) {
  unsigned value = crc ^ std::to_integer<unsigned>(byte);
  value = value >> 4 ^ kTable[value & 0xF];
  value = value >> 4 ^ kTable[value & 0xF];
  return static_cast<std::uint16_t>(value);
}

std::uint16_t crc16(std::span<const std::byte> bytes) {
  std::uint16_t crc = kCrcBegin;
  for (const std::byte byte : bytes) crc = crc16_add(crc, byte);
  return crc;
}

}  // namespace stepwright::modbus::pdu
