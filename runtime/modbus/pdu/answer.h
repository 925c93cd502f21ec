#pragma once

// Answers of a slave, written into a buffer of the caller. Every function returns the length of the answer
// PDU.
//
// Portable, no heap, any thread. `out` needs kMaxPdu bytes.
//
// An answer that carries a table is filled in place, without a copy:
//
//   const Exception e = model.read_registers(table, address, count, table_data(out, count * 2));
//   return e == Exception::None ? answer_table(function, count * 2, out) : answer_exception(...);

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/modbus/pdu/request.h"

namespace stepwright::modbus::pdu {

// How many bytes of bits or registers the answer to a request of FC 1 to 4 or 23 carries; at most 250.
std::size_t table_bytes(const Request& request);

// Where they stand in the answer.
std::span<std::byte> table_data(std::span<std::byte> out, std::size_t bytes);

// The answer around `bytes` bytes that already stand in table_data().
std::size_t answer_table(Function function, std::size_t bytes, std::span<std::byte> out);

// The same with a copy: packed bits (FC 1, 2); big-endian registers (FC 3, 4, 23).
std::size_t answer_bits(Function function, std::span<const std::byte> packed, std::span<std::byte> out);
std::size_t answer_registers(Function function, std::span<const std::byte> words, std::span<std::byte> out);

// The answer to a write that is carried out: FC 5, 6 and 22 repeat the request; 15 and 16 address and count.
std::size_t answer_write(const Request& request, std::span<std::byte> out);

// Function code with its top bit set, and the exception. Of a function code that has the bit already it stays
// set.
std::size_t answer_exception(std::uint8_t function, Exception exception, std::span<std::byte> out);

}  // namespace stepwright::modbus::pdu
