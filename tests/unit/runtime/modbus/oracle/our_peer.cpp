#include "tests/unit/runtime/modbus/oracle/our_peer.h"

#include <array>
#include <string_view>

#include "runtime/modbus/pdu/request.h"
#include "runtime/modbus/pdu/serve.h"
#include "runtime/modbus/pdu/wire.h"

namespace stepwright::modbus::oracle {

namespace {

using pdu::Exception;

// As pymodbus_peer.py identifies itself.
constexpr std::array<std::string_view, 3> kIdentity{"Stepwright", "oracle", "1.0"};

template <typename Values>
bool holds(const Values& values, std::size_t address, std::size_t count) {
  return address + count <= values.size();
}

}  // namespace

Exception TableModel::read_bits(pdu::BitTable table, std::uint16_t address, std::uint16_t count,
                                std::span<std::byte> packed) {
  const auto& bits = table == pdu::BitTable::Coils ? tables_.coils : tables_.discrete_inputs;
  if (!holds(bits, address, count)) return Exception::IllegalDataAddress;
  for (std::byte& each : packed) each = std::byte{0};
  for (std::size_t i = 0; i < count; ++i) packed[i / 8] |= std::byte{bits[address + i]} << (i % 8);
  return Exception::None;
}

Exception TableModel::read_registers(pdu::RegisterTable table, std::uint16_t address, std::uint16_t count,
                                     std::span<std::byte> words) {
  const auto& registers =
      table == pdu::RegisterTable::Holding ? tables_.holding_registers : tables_.input_registers;
  if (!holds(registers, address, count)) return Exception::IllegalDataAddress;
  for (std::size_t i = 0; i < count; ++i) pdu::put16(words, 2 * i, registers[address + i]);
  return Exception::None;
}

Exception TableModel::write_coils(std::uint16_t address, std::uint16_t count,
                                  std::span<const std::byte> packed) {
  if (!holds(tables_.coils, address, count)) return Exception::IllegalDataAddress;
  for (std::size_t i = 0; i < count; ++i) {
    tables_.coils[address + i] = std::to_integer<std::uint8_t>(packed[i / 8] >> (i % 8) & std::byte{1});
  }
  return Exception::None;
}

Exception TableModel::write_registers(std::uint16_t address, std::uint16_t count,
                                      std::span<const std::byte> words) {
  if (!holds(tables_.holding_registers, address, count)) return Exception::IllegalDataAddress;
  for (std::size_t i = 0; i < count; ++i) tables_.holding_registers[address + i] = pdu::get16(words, 2 * i);
  return Exception::None;
}

Exception TableModel::mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) {
  if (!holds(tables_.holding_registers, address, 1)) return Exception::IllegalDataAddress;
  std::uint16_t& value = tables_.holding_registers[address];
  value = pdu::masked(value, and_mask, or_mask);
  return Exception::None;
}

Exception TableModel::read_write_registers(const pdu::ReadWrite& what, std::span<std::byte> words) {
  if (!holds(tables_.holding_registers, what.read_address, what.read_count))
    return Exception::IllegalDataAddress;
  const Exception written = write_registers(what.write_address, what.write_count, what.words);
  if (written != Exception::None) return written;
  return read_registers(pdu::RegisterTable::Holding, what.read_address, what.read_count, words);
}

std::span<const std::byte> TableModel::identification(std::uint8_t object) const {
  if (object >= kIdentity.size()) return {};
  return std::as_bytes(std::span(kIdentity[object]));
}

Answer OurPeer::ask(const Bytes& pdu) {
  std::array<std::byte, pdu::kMaxPdu> out{};
  Answer answer;
  const std::size_t length = pdu::serve(model_, std::as_bytes(std::span(pdu)), out);
  for (std::size_t i = 0; i < length; ++i) answer.pdu.push_back(std::to_integer<std::uint8_t>(out[i]));
  if (length > 0) answer.reaction = Reaction::Answered;
  answer.changes = changes(initial_.view(), tables_.view());
  if (!answer.changes.empty()) tables_ = initial_;
  return answer;
}

}  // namespace stepwright::modbus::oracle
