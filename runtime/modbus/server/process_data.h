#pragma once

// Interface to the values that a Modbus server serves: those of a controller. Reads are answered at once;
// writes when the controller has them. RuntimeData (runtime_data.h) implements it over a runtime's service;
// tests have tables of their own.
//
// Threads: one, the server's. Nothing blocks.

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/modbus/pdu/exception.h"
#include "runtime/modbus/pdu/request.h"

namespace stepwright::modbus::server {

struct Written {
  std::uint64_t ticket = 0;
  pdu::Exception exception = pdu::Exception::None;
};

class ProcessData {
 public:
  virtual ~ProcessData() = default;

  // Fills what a request of FC 1 to 4 asks for, or the read half of FC 23; `table` has
  // pdu::table_bytes(request) bytes. 4: nobody knows the values now.
  virtual pdu::Exception read(const pdu::Request& request, std::span<std::byte> table) = 0;
  // Begins the write of a request that writes. None: take_written() will give `ticket` once, whatever
  // happens. Else nothing is written. Of FC 23 the read half is judged too, before anything is written.
  virtual pdu::Exception begin_write(std::uint64_t ticket, const pdu::Request& request) = 0;
  virtual std::optional<Written> take_written() = 0;
  // Readable when take_written() has something; `clear` makes it unreadable until there is more.
  virtual int descriptor() const = 0;
  virtual void clear() = 0;
};

}  // namespace stepwright::modbus::server
