#pragma once

// A serial line as Modbus RTU needs it: raw bytes, without waiting, this process's alone.
//
//   auto line = SerialLine::open({.device = "/dev/ttyUSB0", .baud = 19'200, .parity = Parity::Even});
//   if (!line) ... line.error() ...
//   line->read(buffer);
//
// Threads: one. The device is locked (flock) while the object lives, against a second slave or a master of
// ours on the same line, and nobody but root may open it (TIOCEXCL).

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

enum class Parity : std::uint8_t { None, Even, Odd };

// Defaults are those of Modbus over Serial Line V1.02, 2.5.1; without parity it wants two stop bits.
struct LineOptions {
  std::filesystem::path device;  // "/dev/ttyUSB0", a pseudo terminal
  std::uint32_t baud = 19'200;   // one of line_speeds()
  Parity parity = Parity::Even;
  std::uint8_t stop_bits = 1;  // 1 or 2; there are always 8 data bits
  bool rs485 = false;          // the kernel's driver switches the transmitter (TIOCSRS485)
  std::uint8_t unit = 1;       // the address of this slave on the line, 1 to 247
  result::Location where;      // of the settings, for diagnostics
};

// The speeds that a line can have, in baud, ascending.
std::span<const std::uint32_t> line_speeds();

// "19200 8E1".
std::string line_text(const LineOptions& options);

class SerialLine {
 public:
  // Fails with R0111 where the device cannot be opened or is no serial line, R0112 where another process has
  // it, R0113 where it does not take the settings.
  [[nodiscard]] static result::Result<SerialLine> open(const LineOptions& options);
  SerialLine(SerialLine&& other) noexcept;
  SerialLine& operator=(SerialLine&&) = delete;
  ~SerialLine();

  int descriptor() const { return descriptor_; }
  // Closed when the device is gone: an adapter that was pulled out, the other end of a pseudo terminal.
  Moved read(std::span<std::byte> into);
  Moved write(std::span<const std::byte> from);

 private:
  explicit SerialLine(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace stepwright::modbus::server
