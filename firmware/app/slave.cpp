#include "firmware/app/slave.h"

#include <array>
#include <cstring>

#include "runtime/modbus/pdu/wire.h"

namespace stepwright::app {

using modbus::pdu::BitTable;
using modbus::pdu::Exception;
using modbus::pdu::ReadWrite;
using modbus::pdu::RegisterTable;

Exception Slave::read_bits(BitTable table, std::uint16_t address, std::uint16_t count,
                           std::span<std::byte> packed) {
  return map_.read_bits(table, address, count, packed);
}

Exception Slave::may_read(RegisterTable table, std::uint16_t address, std::uint16_t count) {
  if (table == RegisterTable::Holding && ControlRegisters::holds(address))
    return ControlRegisters::may_read(address, count);
  return map_.has(table, address, count) ? Exception::None : Exception::IllegalDataAddress;
}

Exception Slave::read_registers(RegisterTable table, std::uint16_t address, std::uint16_t count,
                                std::span<std::byte> words) {
  const Exception allowed = may_read(table, address, count);
  if (allowed != Exception::None) return allowed;
  if (table == RegisterTable::Holding && ControlRegisters::holds(address)) {
    registers_.read(address, count, words);
  } else {
    map_.read(table, address, count, words);
  }
  return Exception::None;
}

Exception Slave::write_coils(std::uint16_t address, std::uint16_t count, std::span<const std::byte> packed) {
  const Exception written = map_.write_coils(address, count, packed);
  controller_.touched();
  return written;
}

Exception Slave::write_registers(std::uint16_t address, std::uint16_t count,
                                 std::span<const std::byte> words) {
  if (ControlRegisters::holds(address)) return registers_.write(address, count, words);
  if (!map_.has(RegisterTable::Holding, address, count)) return Exception::IllegalDataAddress;
  map_.write(address, count, words);
  controller_.touched();
  return Exception::None;
}

// Only a variable of the program: no register of the controller can be both read and written.
Exception Slave::mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) {
  if (!map_.has(RegisterTable::Holding, address, 1)) return Exception::IllegalDataAddress;
  std::array<std::byte, 2> word;
  map_.read(RegisterTable::Holding, address, 1, word);
  modbus::pdu::put16(word, 0, modbus::pdu::masked(modbus::pdu::get16(word, 0), and_mask, or_mask));
  map_.write(address, 1, word);
  controller_.touched();
  return Exception::None;
}

// The read half is judged first, so that nothing is written by a request that is refused.
Exception Slave::read_write_registers(const ReadWrite& what, std::span<std::byte> words) {
  const Exception readable = may_read(RegisterTable::Holding, what.read_address, what.read_count);
  if (readable != Exception::None) return readable;
  const Exception written = write_registers(what.write_address, what.write_count, what.words);
  if (written != Exception::None) return written;
  return read_registers(RegisterTable::Holding, what.read_address, what.read_count, words);
}

std::span<const std::byte> Slave::identification(std::uint8_t object) const {
  constexpr const char* kTexts[] = {"Stepwright", nullptr, STEPWRIGHT_VERSION, "", "Stepwright firmware",
                                    "",           ""};
  if (object >= std::size(kTexts)) return {};
  const char* text = object == 1 ? controller_.board_name() : kTexts[object];
  return std::as_bytes(std::span(text, std::strlen(text)));
}

}  // namespace stepwright::app
