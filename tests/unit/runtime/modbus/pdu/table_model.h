#pragma once

// Tables of a few bits and registers, for tests of the engine.

#include <array>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/modbus/pdu/data_model.h"
#include "runtime/modbus/pdu/wire.h"

namespace stepwright::modbus::pdu {

using Bytes = std::vector<std::byte>;

inline Bytes bytes(std::initializer_list<unsigned> values) {
  Bytes out;
  for (const unsigned value : values) out.push_back(static_cast<std::byte>(value));
  return out;
}

inline std::string hex(std::span<const std::byte> data) {
  std::string out;
  for (const std::byte b : data) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    if (!out.empty()) out += ' ';
    out += kDigits[std::to_integer<std::size_t>(b) >> 4];
    out += kDigits[std::to_integer<std::size_t>(b) & 15];
  }
  return out;
}

class TableModel final : public DataModel {
 public:
  static constexpr std::size_t kSize = 300;

  Exception read_bits(BitTable table, std::uint16_t address, std::uint16_t count,
                      std::span<std::byte> packed) override {
    if (address + count > kSize) return Exception::IllegalDataAddress;
    std::memset(packed.data(), 0, packed.size());
    const auto& from = table == BitTable::Coils ? coils : discrete;
    for (std::size_t i = 0; i < count; ++i)
      if (from[address + i]) packed[i / 8] |= static_cast<std::byte>(1u << i % 8);
    return Exception::None;
  }
  Exception read_registers(RegisterTable table, std::uint16_t address, std::uint16_t count,
                           std::span<std::byte> words) override {
    if (address + count > kSize) return Exception::IllegalDataAddress;
    const auto& from = table == RegisterTable::Holding ? holding : input;
    for (std::size_t i = 0; i < count; ++i) put16(words, 2 * i, from[address + i]);
    return Exception::None;
  }
  Exception write_coils(std::uint16_t address, std::uint16_t count,
                        std::span<const std::byte> packed) override {
    ++writes;
    if (address + count > kSize) return Exception::IllegalDataAddress;
    for (std::size_t i = 0; i < count; ++i)
      coils[address + i] = (std::to_integer<unsigned>(packed[i / 8]) >> i % 8 & 1) != 0;
    return Exception::None;
  }
  Exception write_registers(std::uint16_t address, std::uint16_t count,
                            std::span<const std::byte> words) override {
    ++writes;
    if (address + count > kSize) return Exception::IllegalDataAddress;
    for (std::size_t i = 0; i < count; ++i) holding[address + i] = get16(words, 2 * i);
    return Exception::None;
  }
  Exception mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) override {
    ++writes;
    if (address >= kSize) return Exception::IllegalDataAddress;
    holding[address] = masked(holding[address], and_mask, or_mask);
    return Exception::None;
  }
  Exception read_write_registers(const ReadWrite& what, std::span<std::byte> words) override {
    if (what.read_address + what.read_count > kSize) return Exception::IllegalDataAddress;
    const Exception exception = write_registers(what.write_address, what.write_count, what.words);
    if (exception != Exception::None) return exception;
    return read_registers(RegisterTable::Holding, what.read_address, what.read_count, words);
  }
  std::span<const std::byte> identification(std::uint8_t object) const override {
    return std::as_bytes(std::span(objects[object]));
  }

  std::array<bool, kSize> coils{};
  std::array<bool, kSize> discrete{};
  std::array<std::uint16_t, kSize> holding{};
  std::array<std::uint16_t, kSize> input{};
  std::array<std::string, 7> objects{"Stepwright", "soft PLC", "0.1"};
  int writes = 0;
};

}  // namespace stepwright::modbus::pdu
