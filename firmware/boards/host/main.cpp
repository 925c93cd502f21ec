// The firmware as a process of this machine: its serial line is a pty, its flash a file. For tests, and for
// trying a gateway without QEMU. SIGUSR1 is its reset button: it starts again with what the flash has.
//
//   firmware_host FLASH_FILE                  prints the device of its line
//   firmware_host --link PATH FLASH_FILE      the device has that name, too
//   firmware_host --tcp PORT FLASH_FILE       Modbus TCP on the loopback in the place of the line;
//                                             0: any port

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "firmware/app/firmware.h"
#include "firmware/boards/emulated/ram_flash.h"
#include "firmware/boards/host/host_tick.h"
#include "firmware/boards/host/pty_uart.h"
#include "firmware/boards/host/switches.h"
#include "firmware/boards/host/tcp_line.h"

namespace stepwright::boards {
namespace {

constexpr std::size_t kFlashBytes = 2u << 20;
constexpr std::size_t kMemoryBytes = 2u << 20;

struct Options {
  std::string flash_file;
  std::string link;
  std::optional<std::uint16_t> tcp_port;
};

// Nobody resets a process; a supervisor of the system may.
class NoWatchdog final : public port::Watchdog {
 public:
  void start(std::uint32_t) override {}
  void feed() override {}
  std::uint16_t resets() const override { return 0; }
  bool caused_this_start() const override { return false; }
};

// Where Modbus TCP stands in the place of the serial line.
class NoUart final : public port::Uart {
 public:
  std::size_t read(std::span<std::byte>) override { return 0; }
  std::size_t write(std::span<const std::byte>) override { return 0; }
};

// The main loop of app::Firmware with the other line.
class TcpFirmware {
 public:
  TcpFirmware(port::Board& board, TcpLine& line)
      : tick_(board.tick), line_(line), controller_(board), slave_(controller_) {}

  void boot() { controller_.boot(); }
  void turn() {
    const bool heard = line_.work(slave_);
    const bool worked = controller_.work();
    if (!heard && !worked) tick_.rest();
  }

 private:
  port::Tick& tick_;
  TcpLine& line_;
  app::Controller controller_;
  app::Slave slave_;
};

std::span<std::byte> mapped(const char* path) {
  const int file = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0 || ::ftruncate(file, kFlashBytes) != 0) return {};
  void* const memory = ::mmap(nullptr, kFlashBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  if (memory == MAP_FAILED) return {};
  return {static_cast<std::byte*>(memory), kFlashBytes};
}

int failed(const std::string& what) {
  std::perror(what.c_str());
  return 1;
}

// Powered until it is switched off. `Line` is what the firmware needs beside the board.
template <typename Firmware, typename... Line>
int run(const Options& options, const std::string& where, int descriptor, port::Uart& uart, Line&... line) {
  const std::span<std::byte> flash_memory = mapped(options.flash_file.c_str());
  if (flash_memory.empty()) return failed(options.flash_file);
  RamFlash flash(flash_memory);
  HostTick tick(descriptor);
  NoWatchdog watchdog;
  std::vector<std::uint64_t> memory(kMemoryBytes / sizeof(std::uint64_t));
  port::Board board{"host", tick, uart, flash, watchdog, std::as_writable_bytes(std::span(memory))};
  Switches switches;  // before anybody is told of the board and may use them
  std::printf("%s\n", where.c_str());
  std::fflush(stdout);
  for (Switch used = Switch::Reset; used != Switch::Off;) {
    tick.restart();
    Firmware firmware(board, line...);
    firmware.boot();
    do {
      firmware.turn();
      used = switches.used();
    } while (used == Switch::None);
  }
  return 0;
}

int run(const Options& options) {
  if (options.tcp_port) {
    TcpLine line(*options.tcp_port);
    if (!line.ok()) return failed("port " + std::to_string(*options.tcp_port));
    NoUart uart;
    return run<TcpFirmware>(options, line.name(), line.descriptor(), uart, line);
  }
  PtyUart uart(options.link);
  if (!uart.ok()) return failed(options.link.empty() ? "pty" : options.link);
  return run<app::Firmware>(options, uart.name(), uart.descriptor(), uart);
}

std::optional<Options> parsed(int argc, char** argv) {
  Options options;
  if (argc == 4 && std::strcmp(argv[1], "--link") == 0) {
    options.link = argv[2];
  } else if (argc == 4 && std::strcmp(argv[1], "--tcp") == 0) {
    std::uint16_t port = 0;
    const char* const end = argv[2] + std::strlen(argv[2]);
    const auto read = std::from_chars(argv[2], end, port);
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
    options.tcp_port = port;
  } else if (argc != 2 || argv[1][0] == '-') {
    return std::nullopt;
  }
  options.flash_file = argv[argc - 1];
  return options;
}

}  // namespace
}  // namespace stepwright::boards

int main(int argc, char** argv) {
  using namespace stepwright::boards;
  const auto options = parsed(argc, argv);
  if (!options) {
    std::fprintf(stderr, "usage: firmware_host [--link PATH | --tcp PORT] FLASH_FILE\n");
    return 2;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  return run(*options);
}
