#include "firmware/link/qemu_board.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace stepwright::link {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPatience{20};
constexpr std::chrono::milliseconds kLook{5};
constexpr const char* kProgram = "qemu-system-arm";
constexpr std::uintmax_t kFlashFileBytes = 16u << 20;  // the PSRAM of the MPS2 board

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// "char device redirected to /dev/pts/3 (label serial0)"
std::string line_in(const std::string& log) {
  const auto at = log.find("/dev/pts/");
  const auto end = log.find(' ', at);
  return at == std::string::npos || end == std::string::npos ? "" : log.substr(at, end - at);
}

std::vector<std::string> arguments_of(const QemuOptions& options) {
  const std::string flash = (options.folder / "flash.bin").string();
  std::vector<std::string> arguments = {kProgram,
                                        "-M",
                                        options.machine + ",memory-backend=flash",
                                        "-object",
                                        "memory-backend-file,id=flash,size=16M,share=on,mem-path=" + flash,
                                        "-display",
                                        "none",
                                        "-monitor",
                                        "none",
                                        "-serial",
                                        "pty",
                                        "-kernel",
                                        options.image.string()};
  if (options.icount_shift) {
    arguments.insert(arguments.end(), {"-icount", "shift=" + std::to_string(*options.icount_shift)});
  }
  if (options.debugger) {
    const std::string socket = (options.folder / "gdb.sock").string();
    arguments.insert(arguments.end(),
                     {"-chardev", "socket,id=gdb,server=on,wait=off,path=" + socket, "-gdb", "chardev:gdb"});
  }
  return arguments;
}

pid_t spawn(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t pid = ::fork();
  if (pid != 0) return pid;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

tl::unexpected<result::Diagnostics> failed(const QemuOptions& options, const std::string& what) {
  return result::fail("R0131", {options.image.string(), 0, 0}, "QEMU cannot run the firmware: " + what,
                      "is qemu-system-arm installed, and the firmware built (scripts/build)?");
}

}  // namespace

result::Result<QemuBoard> QemuBoard::start(const QemuOptions& options) {
  std::error_code error;
  if (!std::filesystem::exists(options.image, error)) return failed(options, "there is no such file");
  const std::filesystem::path flash = options.folder / "flash.bin";
  if (!std::filesystem::exists(flash, error)) {
    std::ofstream{flash};
    std::filesystem::resize_file(flash, kFlashFileBytes, error);
    if (error) return failed(options, flash.string() + ": " + error.message());
  }
  const std::filesystem::path log = options.folder / "qemu.log";
  std::filesystem::remove(log, error);
  QemuBoard board(spawn(arguments_of(options), log), "", options.folder);
  if (board.pid_ < 0) return failed(options, "no process");
  for (const auto deadline = Clock::now() + kPatience; Clock::now() < deadline;) {
    board.line_ = line_in(text_of(log));
    if (!board.line_.empty()) return board;
    if (!board.alive()) break;
    std::this_thread::sleep_for(kLook);
  }
  return failed(options, text_of(log));
}

QemuBoard::QemuBoard(pid_t pid, std::string line, std::filesystem::path folder)
    : pid_(pid), line_(std::move(line)), folder_(std::move(folder)) {}

QemuBoard::QemuBoard(QemuBoard&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), line_(std::move(other.line_)), folder_(std::move(other.folder_)) {}

QemuBoard& QemuBoard::operator=(QemuBoard&& other) noexcept {
  kill();
  pid_ = std::exchange(other.pid_, -1);
  line_ = std::move(other.line_);
  folder_ = std::move(other.folder_);
  return *this;
}

QemuBoard::~QemuBoard() {
  kill();
}

bool QemuBoard::alive() const {
  siginfo_t info{};
  return pid_ > 0 && ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == 0;
}

void QemuBoard::kill() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

}  // namespace stepwright::link
