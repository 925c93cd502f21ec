#include "runtime/ground/process/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

#include "runtime/ground/process/subreaper.h"

namespace stepwright::process {
namespace {

constexpr int kCannotStart = 127;  // exit code of a child that did not become the program

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
  all.push_back(nullptr);
  return all;
}

// That of this process, with other values for the names in `changed`.
std::vector<std::string> environment_with(const std::vector<std::string>& changed) {
  std::vector<std::string> all = changed;
  const auto is_changed = [&](std::string_view entry) {
    const std::string_view name = entry.substr(0, entry.find('=') + 1);
    for (const std::string& each : changed)
      if (each.starts_with(name)) return true;
    return false;
  };
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (!is_changed(*entry)) all.emplace_back(*entry);
  return all;
}

// As 3, 4, ...; first out of the way of each other. Between fork and exec.
void hand_down(const std::vector<int>& descriptors) {
  constexpr int kFirst = STDERR_FILENO + 1;
  constexpr int kAside = 64;
  constexpr std::size_t kMost = 16;
  int aside[kMost] = {};
  const std::size_t count = descriptors.size() < kMost ? descriptors.size() : kMost;
  for (std::size_t i = 0; i < count; ++i) aside[i] = fcntl(descriptors[i], F_DUPFD, kAside);
  for (std::size_t i = 0; i < count; ++i) {
    if (dup2(aside[i], kFirst + static_cast<int>(i)) < 0) _exit(kCannotStart);
  }
  static_cast<void>(close_range(kFirst + static_cast<unsigned>(count), ~0u, 0));
}

// Between fork and exec: calls of the system only.
void become_child(pid_t parent, const char* log, int output) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // the parent died before the line above
  setpgid(0, 0);
  if (log != nullptr) output = open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (output < 0) return;
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
}

// While it lives no signal reaches this thread; a child that is forked meanwhile begins so, too.
class BlockedSignals {
 public:
  BlockedSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

void unblock_signals() {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace

result::Result<ChildProcess> ChildProcess::start(const ChildOptions& options) {
  const std::vector<char*> argv = pointers(options.arguments);
  const std::vector<std::string> environment = environment_with(options.environment);
  const std::vector<char*> envp = pointers(environment);
  if (access(argv[0], X_OK) != 0) {
    return result::fail("M0001", {options.arguments[0], 0, 0},
                        std::string("cannot be started: ") + std::strerror(errno),
                        "is it built, or installed? (scripts/build release programs)");
  }
  const pid_t parent = getpid();
  const char* const log = options.log.empty() ? nullptr : options.log.c_str();
  const char* const folder = options.folder.empty() ? nullptr : options.folder.c_str();
  // A handler of this process is not to run in the child.
  const BlockedSignals blocked;
  const pid_t pid = fork();
  if (pid < 0) return result::fail("M0001", {}, std::string("cannot fork: ") + std::strerror(errno));
  if (pid == 0) {
    become_child(parent, log, options.output);
    if (folder != nullptr && chdir(folder) != 0) _exit(kCannotStart);
    if (!options.descriptors.empty()) hand_down(options.descriptors);
    if (options.with_descendants) stand_over_program();
    unblock_signals();
    execve(argv[0], argv.data(), envp.data());
    _exit(kCannotStart);
  }
  return ChildProcess(pid, options.with_descendants ? kKillProgram : SIGKILL);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), kill_signal_(other.kill_signal_), status_(other.status_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(kill_signal_, other.kill_signal_);
  std::swap(status_, other.status_);
  return *this;
}

ChildProcess::~ChildProcess() {
  end(std::chrono::milliseconds(2'000));
}

std::optional<ExitStatus> ChildProcess::poll() {
  if (pid_ < 0 || status_) return status_;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  status_ =
      WIFSIGNALED(status) ? ExitStatus{128 + WTERMSIG(status), true} : ExitStatus{WEXITSTATUS(status), false};
  return status_;
}

// To nobody else: the number of a process that was reaped may be another's.
void ChildProcess::signal(int number) {
  if (pid_ >= 0 && !poll()) kill(pid_, number);
}

void ChildProcess::ask_to_end() {
  signal(SIGTERM);
}

void ChildProcess::kill_now() {
  signal(kill_signal_);
  if (kill_signal_ != SIGKILL) signal(SIGCONT);  // it may be stopped
}

void ChildProcess::end(std::chrono::milliseconds patience) {
  if (pid_ < 0 || poll()) return;
  ask_to_end();
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!poll()) {
    if (std::chrono::steady_clock::now() > deadline) kill_now();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace stepwright::process
