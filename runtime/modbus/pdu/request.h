#pragma once

// A request as the slave's engine sees it: every length and count in it has been checked against the bytes
// that arrived, so whoever carries it out looks at addresses only.
//
// Portable, no heap, any thread. `data` points into the bytes that were parsed.
//
//   const Parsed parsed = parse(pdu);
//   if (parsed.exception != Exception::None) return answer_exception(parsed.function, parsed.exception, out);
//   switch (parsed.request.function) { ... }

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/modbus/pdu/exception.h"

namespace stepwright::modbus::pdu {

inline constexpr std::size_t kMaxPdu = 253;  // V1.1b3, 4.1: 256 bytes of RTU less address and CRC
inline constexpr std::uint16_t kMaxReadBits = 2000;
inline constexpr std::uint16_t kMaxReadRegisters = 125;
inline constexpr std::uint16_t kMaxWriteBits = 1968;
inline constexpr std::uint16_t kMaxWriteRegisters = 123;
inline constexpr std::uint16_t kMaxReadWriteRegisters = 121;  // the write half of FC 23

// The function codes that are served (V1.1b3, section 6).
enum class Function : std::uint8_t {
  ReadCoils = 1,
  ReadDiscreteInputs = 2,
  ReadHoldingRegisters = 3,
  ReadInputRegisters = 4,
  WriteSingleCoil = 5,
  WriteSingleRegister = 6,
  WriteMultipleCoils = 15,
  WriteMultipleRegisters = 16,
  MaskWriteRegister = 22,
  ReadWriteMultipleRegisters = 23,
  EncapsulatedInterface = 43,  // with MEI type 14: read device identification
};

struct Request {
  Function function{};
  // Range that is read; of a request that only writes, the range that is written. address + count <= 65536,
  // count >= 1.
  std::uint16_t address = 0;
  std::uint16_t count = 0;
  // FC 23: what is written, before the read.
  std::uint16_t write_address = 0;
  std::uint16_t write_count = 0;
  // Data to write. Bits (FC 5, 15): packed, the first one in bit 0 of the first byte, (count + 7) / 8 bytes.
  // Registers (FC 6, 16, 23): two bytes each, the most significant first.
  std::span<const std::byte> data;
  // FC 22: register = (register AND and_mask) OR (or_mask AND NOT and_mask).
  std::uint16_t and_mask = 0;
  std::uint16_t or_mask = 0;
  // FC 43/14: 1 basic, 2 regular, 3 extended, 4 one object.
  std::uint8_t identification_code = 0;
  std::uint8_t object = 0;

  bool writes() const;       // changes something: FC 5, 6, 15, 16, 22, 23
  bool reads_bits() const;   // FC 1, 2
  bool writes_bits() const;  // FC 5, 15
  bool reads_table() const;  // FC 1 to 4, 23: the answer carries bits or registers
};

struct Parsed {
  Exception exception = Exception::None;
  std::uint8_t function = 0;  // as it arrived; 0 of an empty PDU
  Request request;            // whole if there is no exception
};

// Parses a request PDU (function code and data, without address, header and CRC).
// In the order of the state diagrams of V1.1b3: a function that is not served -> 1; a length, count, byte
// count or value that may not be -> 3; a range that goes beyond address 65535 -> 2. An empty PDU gives
// IllegalFunction for function 0. Never reads beyond `pdu`.
Parsed parse(std::span<const std::byte> pdu);

}  // namespace stepwright::modbus::pdu
