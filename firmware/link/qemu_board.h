#pragma once

// A board under QEMU as a child process: its serial line is a pty of this machine, its flash a file. It is
// killed at the latest with its object or with the thread that started it.
//
//   auto board = QemuBoard::start({.machine = "mps2-an385", .image = "build/release/firmware/mps2-an385.elf",
//                                  .folder = state_dir});
//   modbus::master::SerialEndpoint{.device = board->line(), .baud = 115'200, .parity = Parity::None};
//
// Threads: one at a time.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::link {

struct QemuOptions {
  std::string machine;           // "mps2-an385", "mps2-an386"
  std::filesystem::path image;   // the firmware
  std::filesystem::path folder;  // of flash.bin, which outlives the board, and qemu.log; exists
  // Every instruction takes 2^shift ns of the board's time, whatever this machine is doing: for counting
  // cycles. Time then runs slower than on the wall.
  std::optional<int> icount_shift;
  bool debugger = false;  // a GDB stub at `folder`/gdb.sock
};

class QemuBoard {
 public:
  // Fails with R0131 if QEMU cannot be started or names no line in time, with what it said.
  [[nodiscard]] static result::Result<QemuBoard> start(const QemuOptions& options);
  ~QemuBoard();
  QemuBoard(QemuBoard&& other) noexcept;
  QemuBoard& operator=(QemuBoard&& other) noexcept;

  // The device of the serial line, e.g. "/dev/pts/3".
  const std::string& line() const { return line_; }
  std::filesystem::path gdb_socket() const { return folder_ / "gdb.sock"; }
  pid_t pid() const { return pid_; }
  bool alive() const;

  // The power goes: nothing but the flash is left.
  void kill();

 private:
  QemuBoard(pid_t pid, std::string line, std::filesystem::path folder);

  pid_t pid_ = -1;
  std::string line_;
  std::filesystem::path folder_;
};

}  // namespace stepwright::link
