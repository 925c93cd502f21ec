#include "runtime/modbus/pdu/request.h"

#include <array>

#include "runtime/modbus/pdu/wire.h"

namespace stepwright::modbus::pdu {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::array<std::byte, 1> kOff{std::byte{0}};
constexpr std::array<std::byte, 1> kOn{std::byte{1}};
constexpr std::byte kReadDeviceIdentification{0x0E};

bool beyond_the_table(std::uint16_t address, std::uint16_t count) {
  return std::uint32_t{address} + count > 0x1'0000u;
}

Exception read_table(Bytes pdu, std::uint16_t most, Request& request) {
  if (pdu.size() != 5) return Exception::IllegalDataValue;
  request.address = get16(pdu, 1);
  request.count = get16(pdu, 3);
  if (request.count == 0 || request.count > most) return Exception::IllegalDataValue;
  return beyond_the_table(request.address, request.count) ? Exception::IllegalDataAddress : Exception::None;
}

Exception write_single(Bytes pdu, Request& request) {
  if (pdu.size() != 5) return Exception::IllegalDataValue;
  request.address = get16(pdu, 1);
  request.count = 1;
  request.data = pdu.subspan(3);
  if (request.function == Function::WriteSingleRegister) return Exception::None;
  const std::uint16_t value = get16(pdu, 3);
  if (value != 0 && value != 0xFF00) return Exception::IllegalDataValue;
  request.data = value == 0 ? Bytes(kOff) : Bytes(kOn);
  return Exception::None;
}

Exception write_multiple(Bytes pdu, std::uint16_t most, Request& request) {
  if (pdu.size() < 6) return Exception::IllegalDataValue;
  request.address = get16(pdu, 1);
  request.count = get16(pdu, 3);
  if (request.count == 0 || request.count > most) return Exception::IllegalDataValue;
  const bool bits = request.function == Function::WriteMultipleCoils;
  const std::size_t bytes = bits ? (request.count + 7u) / 8u : request.count * 2u;
  request.data = pdu.subspan(6);
  if (std::to_integer<std::size_t>(pdu[5]) != bytes || request.data.size() != bytes)
    return Exception::IllegalDataValue;
  return beyond_the_table(request.address, request.count) ? Exception::IllegalDataAddress : Exception::None;
}

Exception mask_write(Bytes pdu, Request& request) {
  if (pdu.size() != 7) return Exception::IllegalDataValue;
  request.address = get16(pdu, 1);
  request.count = 1;
  request.and_mask = get16(pdu, 3);
  request.or_mask = get16(pdu, 5);
  return Exception::None;
}

Exception read_write(Bytes pdu, Request& request) {
  if (pdu.size() < 10) return Exception::IllegalDataValue;
  request.address = get16(pdu, 1);
  request.count = get16(pdu, 3);
  request.write_address = get16(pdu, 5);
  request.write_count = get16(pdu, 7);
  request.data = pdu.subspan(10);
  if (request.count == 0 || request.count > kMaxReadRegisters) return Exception::IllegalDataValue;
  if (request.write_count == 0 || request.write_count > kMaxReadWriteRegisters)
    return Exception::IllegalDataValue;
  const std::size_t bytes = request.write_count * 2u;
  if (std::to_integer<std::size_t>(pdu[9]) != bytes || request.data.size() != bytes)
    return Exception::IllegalDataValue;
  const bool beyond = beyond_the_table(request.address, request.count) ||
                      beyond_the_table(request.write_address, request.write_count);
  return beyond ? Exception::IllegalDataAddress : Exception::None;
}

Exception encapsulated(Bytes pdu, Request& request) {
  if (pdu.size() < 2) return Exception::IllegalDataValue;
  if (pdu[1] != kReadDeviceIdentification) return Exception::IllegalFunction;
  if (pdu.size() != 4) return Exception::IllegalDataValue;
  request.identification_code = std::to_integer<std::uint8_t>(pdu[2]);
  request.object = std::to_integer<std::uint8_t>(pdu[3]);
  const bool known = request.identification_code >= 1 && request.identification_code <= 4;
  return known ? Exception::None : Exception::IllegalDataValue;
}

Exception parse_into(Bytes pdu, Request& request) {
  switch (request.function) {
    case Function::ReadCoils:
    case Function::ReadDiscreteInputs:
      return read_table(pdu, kMaxReadBits, request);
    case Function::ReadHoldingRegisters:
    case Function::ReadInputRegisters:
      return read_table(pdu, kMaxReadRegisters, request);
    case Function::WriteSingleCoil:
    case Function::WriteSingleRegister:
      return write_single(pdu, request);
    case Function::WriteMultipleCoils:
      return write_multiple(pdu, kMaxWriteBits, request);
    case Function::WriteMultipleRegisters:
      return write_multiple(pdu, kMaxWriteRegisters, request);
    case Function::MaskWriteRegister:
      return mask_write(pdu, request);
    case Function::ReadWriteMultipleRegisters:
      return read_write(pdu, request);
    case Function::EncapsulatedInterface:
      return encapsulated(pdu, request);
  }
  return Exception::IllegalFunction;
}

}  // namespace

bool Request::writes() const {
  switch (function) {
    case Function::WriteSingleCoil:
    case Function::WriteSingleRegister:
    case Function::WriteMultipleCoils:
    case Function::WriteMultipleRegisters:
    case Function::MaskWriteRegister:
    case Function::ReadWriteMultipleRegisters:
      return true;
    default:
      return false;
  }
}

bool Request::reads_bits() const {
  return function == Function::ReadCoils || function == Function::ReadDiscreteInputs;
}

bool Request::writes_bits() const {
  return function == Function::WriteSingleCoil || function == Function::WriteMultipleCoils;
}

bool Request::reads_table() const {
  return reads_bits() || function == Function::ReadHoldingRegisters ||
         function == Function::ReadInputRegisters || function == Function::ReadWriteMultipleRegisters;
}

Parsed parse(Bytes pdu) {
  Parsed parsed;
  if (pdu.empty()) {
    parsed.exception = Exception::IllegalFunction;
    return parsed;
  }
  parsed.function = std::to_integer<std::uint8_t>(pdu[0]);
  parsed.request.function = static_cast<Function>(parsed.function);
  parsed.exception = parse_into(pdu, parsed.request);
  return parsed;
}

}  // namespace stepwright::modbus::pdu
