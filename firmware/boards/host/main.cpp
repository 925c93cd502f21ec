// The firmware as a process of this machine: its serial line is a pty, its flash a file. For tests, and for
// trying a gateway without QEMU.
//
//   firmware_host FLASH_FILE          prints the device of its line

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>
#include <vector>

#include "firmware/app/firmware.h"
#include "firmware/boards/emulated/ram_flash.h"

namespace stepwright::boards {
namespace {

constexpr std::size_t kFlashBytes = 2u << 20;
constexpr std::size_t kMemoryBytes = 2u << 20;

class PtyUart final : public port::Uart {
 public:
  // The other side stays open, so that masters may come and go.
  PtyUart() : line_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (line_ < 0 || ::grantpt(line_) != 0 || ::unlockpt(line_) != 0) return;
    keep_ = ::open(::ptsname(line_), O_RDWR | O_NOCTTY);
    termios raw{};
    ::tcgetattr(keep_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(keep_, TCSANOW, &raw);
  }
  ~PtyUart() {
    ::close(keep_);
    ::close(line_);
  }
  PtyUart(const PtyUart&) = delete;
  PtyUart& operator=(const PtyUart&) = delete;

  bool ok() const { return keep_ >= 0; }
  const char* name() const { return ::ptsname(line_); }
  int descriptor() const { return line_; }

  std::size_t read(std::span<std::byte> bytes) override {
    const ssize_t count = ::read(line_, bytes.data(), bytes.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  std::size_t write(std::span<const std::byte> bytes) override {
    const ssize_t count = ::write(line_, bytes.data(), bytes.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }

 private:
  int line_ = -1;
  int keep_ = -1;
};

class HostTick final : public port::Tick {
 public:
  explicit HostTick(int line) : line_(line) {}
  std::int64_t now_ns() override {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  }
  void rest() override {
    pollfd wait{line_, POLLIN, 0};
    ::poll(&wait, 1, 1);
  }

 private:
  int line_;
};

// Nobody resets a process; a supervisor of the system may.
class NoWatchdog final : public port::Watchdog {
 public:
  void start(std::uint32_t) override {}
  void feed() override {}
  std::uint16_t resets() const override { return 0; }
  bool caused_this_start() const override { return false; }
};

std::span<std::byte> mapped(const char* path) {
  const int file = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0 || ::ftruncate(file, kFlashBytes) != 0) return {};
  void* const memory = ::mmap(nullptr, kFlashBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  if (memory == MAP_FAILED) return {};
  return {static_cast<std::byte*>(memory), kFlashBytes};
}

int run(const char* flash_file) {
  const std::span<std::byte> flash_memory = mapped(flash_file);
  PtyUart uart;
  if (flash_memory.empty() || !uart.ok()) {
    std::perror(flash_memory.empty() ? flash_file : "pty");
    return 1;
  }
  RamFlash flash(flash_memory);
  HostTick tick(uart.descriptor());
  NoWatchdog watchdog;
  std::vector<std::uint64_t> memory(kMemoryBytes / sizeof(std::uint64_t));
  port::Board board{"host", tick, uart, flash, watchdog, std::as_writable_bytes(std::span(memory))};
  app::Firmware firmware(board);
  firmware.boot();
  std::printf("%s\n", uart.name());
  std::fflush(stdout);
  for (;;) firmware.turn();
}

}  // namespace
}  // namespace stepwright::boards

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: firmware_host FLASH_FILE\n");
    return 2;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  return stepwright::boards::run(argv[1]);
}
