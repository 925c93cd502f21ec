#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stepwright::modbus::map {

// The four tables of Modbus (Modbus Application Protocol V1.1b3, 4.3), each with addresses 0 to 65535. The
// tables of bits come first.
enum class Table : std::uint8_t { Coils = 0, DiscreteInputs = 1, HoldingRegisters = 2, InputRegisters = 3 };
inline constexpr std::size_t kTables = 4;
inline constexpr std::uint32_t kAddresses = 65'536;
inline constexpr std::uint32_t kLastAddress = kAddresses - 1;

// As they are called in configurations.
inline constexpr std::array<std::string_view, kTables> kTableNames{"coils", "discrete", "holding", "input"};

constexpr bool holds_bits(Table table) {
  return table == Table::Coils || table == Table::DiscreteInputs;
}
// Clients can never write the other two.
constexpr bool may_be_written(Table table) {
  return table == Table::Coils || table == Table::HoldingRegisters;
}
constexpr std::string_view name_of(Table table) {
  return kTableNames[static_cast<std::size_t>(table)];
}

}  // namespace stepwright::modbus::map
