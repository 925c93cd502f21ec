#pragma once

// Outcome of a request to a slave. A value without heap, because a master that polls dead slaves makes many.
//
//   const Outcome outcome = master.read_registers(RegisterTable::Holding, 0, words);
//   if (outcome.fault == Fault::Exception && outcome.exception == 2) ...    // no such address there
//   if (auto read = outcome.result(where); !read) return result::forward(read);
//
// Pure; any thread.

#include <cstdint>
#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::modbus::master {

enum class Fault : std::uint8_t {
  None,
  NotConnected,    // R0121: refused, unreachable, no such device, name unknown
  Timeout,         // R0122: no whole answer in time; the connection may be sound
  ConnectionLost,  // R0123: reset, closed, device gone
  Exception,       // R0124: the slave refused; `exception` is its code
  BadAnswer,       // R0125: checksum, transaction, unit, function or length of the answer are wrong
  BadRequest,      // R0126: a count, address or unit outside the protocol; nothing was sent
};

struct [[nodiscard]] Outcome {
  Fault fault = Fault::None;
  std::uint8_t exception = 0;  // of the slave: 1 illegal function, 2 illegal address, 3 illegal value, ...
  int system_error = 0;        // errno or that of libmodbus, where one stands behind it

  bool good() const { return fault == Fault::None; }
  // "no answer within the timeout", "exception 2 (illegal data address)", ...
  std::string text() const;
  // The same as a diagnostic of the codes above; `where` names the slave.
  [[nodiscard]] result::Result<void> result(const result::Location& where) const;
};

// "illegal data address" for 2; "unknown exception" for what the protocol does not define.
// (Modbus Application Protocol V1.1b3, section 7)
const char* exception_name(std::uint8_t exception);

}  // namespace stepwright::modbus::master
