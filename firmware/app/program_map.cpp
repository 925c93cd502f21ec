#include "firmware/app/program_map.h"

#include "runtime/modbus/pdu/wire.h"

namespace stepwright::app {

using modbus::pdu::BitTable;
using modbus::pdu::Exception;
using modbus::pdu::RegisterTable;

namespace {

constexpr std::uint32_t kWords = 1024;  // of %IW, %QW and %MW
constexpr std::uint32_t kMarkerWords = 1024;
constexpr std::uint32_t kMarkerDoubles = 2048;
constexpr std::uint32_t kMarkerLongs = 4096;
constexpr std::uint32_t kMapEnd = 8192;

// Where a register of numbers that take `words` registers lies: the most significant one comes first.
constexpr std::uint32_t byte_of(std::uint32_t index, std::uint32_t words) {
  return index / words * words * 2 + (words - 1 - index % words) * 2;
}

std::span<std::byte> two_of(std::span<std::byte> area, std::uint32_t at) {
  if (at >= area.size()) return {};
  return area.subspan(at, area.size() - at < 2 ? 1 : 2);
}

bool get(std::span<const std::byte> packed, std::uint32_t bit) {
  return (packed[bit / 8] >> (bit % 8) & std::byte{1}) != std::byte{0};
}

}  // namespace

Exception ProgramMap::read_bits(BitTable table, std::uint16_t address, std::uint16_t count,
                                std::span<std::byte> packed) {
  const std::span<std::byte> area = table == BitTable::Coils ? machine_.outputs() : machine_.inputs();
  if (std::uint32_t{address} + count > area.size() * 8) return Exception::IllegalDataAddress;
  for (std::byte& byte : packed) byte = std::byte{0};
  for (std::uint32_t i = 0; i < count; ++i) packed[i / 8] |= std::byte{get(area, address + i)} << (i % 8);
  return Exception::None;
}

Exception ProgramMap::write_coils(std::uint16_t address, std::uint16_t count,
                                  std::span<const std::byte> packed) {
  const std::span<std::byte> area = machine_.outputs();
  if (std::uint32_t{address} + count > area.size() * 8) return Exception::IllegalDataAddress;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t bit = address + i;
    image::set_bit(area, bit / 8, static_cast<std::uint8_t>(bit % 8), get(packed, i));
  }
  return Exception::None;
}

std::span<std::byte> ProgramMap::cell(RegisterTable table, std::uint16_t address) {
  if (address >= kMapEnd || (table == RegisterTable::Input && address >= kWords)) return {};
  if (address < kWords)
    return two_of(table == RegisterTable::Input ? machine_.inputs() : machine_.outputs(), address * 2u);
  if (address < kMarkerDoubles) return two_of(machine_.markers(), byte_of(address - kMarkerWords, 1));
  if (address < kMarkerLongs) return two_of(machine_.markers(), byte_of(address - kMarkerDoubles, 2));
  return two_of(machine_.markers(), byte_of(address - kMarkerLongs, 4));
}

bool ProgramMap::has(RegisterTable table, std::uint16_t address, std::uint16_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (address + i > 0xFFFF || cell(table, static_cast<std::uint16_t>(address + i)).empty()) return false;
  }
  return true;
}

void ProgramMap::read(RegisterTable table, std::uint16_t address, std::uint16_t count,
                      std::span<std::byte> words) {
  for (std::uint16_t i = 0; i < count; ++i) {
    const auto bytes = cell(table, static_cast<std::uint16_t>(address + i));
    words[i * 2u] = bytes.size() > 1 ? bytes[1] : std::byte{0};
    words[i * 2u + 1] = bytes[0];
  }
}

void ProgramMap::write(std::uint16_t address, std::uint16_t count, std::span<const std::byte> words) {
  for (std::uint16_t i = 0; i < count; ++i) {
    const auto bytes = cell(RegisterTable::Holding, static_cast<std::uint16_t>(address + i));
    if (bytes.size() > 1) bytes[1] = words[i * 2u];
    bytes[0] = words[i * 2u + 1];
  }
}

}  // namespace stepwright::app
