#include "programs/demo/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

namespace stepwright::demo {

result::Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& arguments,
                                                 const std::filesystem::path& log) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  if (access(argv[0], X_OK) != 0) {
    return result::fail("M0001", {arguments[0], 0, 0},
                        std::string("cannot be started: ") + std::strerror(errno),
                        "is it built? (scripts/demo builds everything)");
  }
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) return result::fail("M0001", {}, std::string("cannot fork: ") + std::strerror(errno));
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);  // the parent died before the line above
    setpgid(0, 0);                      // Ctrl-C reaches the parent only, which ends its children in order
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (out >= 0) {
      dup2(out, STDOUT_FILENO);
      dup2(out, STDERR_FILENO);
    }
    execv(argv[0], argv.data());
    _exit(127);
  }
  return ChildProcess(pid);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), status_(other.status_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
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

void ChildProcess::end(std::chrono::milliseconds patience) {
  if (pid_ < 0 || poll()) return;
  kill(pid_, SIGTERM);
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!poll()) {
    if (std::chrono::steady_clock::now() > deadline) kill(pid_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace stepwright::demo
