#pragma once

// The holding registers of one controller, whatever carries them: Modbus RTU or TCP (modbus_line.h), a
// controller in the same process in tests.
//
// Threads: one thread uses a line. Every call blocks until the answer is there or its timeout has passed.

#include <cstdint>
#include <span>
#include <string>

namespace stepwright::remote {

enum class LineFault : std::uint8_t {
  None,
  Silent,   // no answer in time
  Garbled,  // an answer that is none: CRC, length, another unit or function
  Refused,  // a Modbus exception: the controller is there and does not want to
  Closed,   // the device or connection is gone; `reopen` may bring it back
};

struct LineAnswer {
  LineFault fault = LineFault::None;
  std::uint8_t exception = 0;  // LineFault::Refused: its code (Modbus Application Protocol V1.1b3, clause 7)
  std::string detail = {};     // what the system or the library says about it

  bool ok() const { return fault == LineFault::None; }
};

class RegisterLine {
 public:
  virtual ~RegisterLine() = default;

  // FC 3. Requires 1 to 125 words.
  virtual LineAnswer read(std::uint16_t first, std::span<std::uint16_t> words) = 0;
  // FC 16. Requires 1 to 123 words.
  virtual LineAnswer write(std::uint16_t first, std::span<const std::uint16_t> words) = 0;
  // FC 23: writes, then reads, in one request. Requires 1 to 121 words to write, 1 to 125 to read.
  virtual LineAnswer read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                std::uint16_t read_first, std::span<std::uint16_t> read) = 0;

  // Closes what is open and opens it again; late answers of earlier requests do not come any more.
  virtual LineAnswer reopen() = 0;
  // For people: "/dev/ttyUSB0", "10.0.0.7:502".
  virtual std::string name() const = 0;
};

}  // namespace stepwright::remote
