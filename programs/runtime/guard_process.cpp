#include "programs/runtime/guard_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

namespace stepwright::cell_runtime {
namespace {

constexpr int kPatienceMs = 5'000;

tl::unexpected<result::Diagnostics> failed(const std::filesystem::path& log, const std::string& why) {
  return result::fail("R0046", {log.string(), 0, 0}, "no guard watches: " + why,
                      "its own words are in this file; [guard] enabled = false runs without one");
}

// The guard, twice removed from the runtime: a session of its own, so that no signal to the runtime's group
// reaches it, and no child that somebody would have to wait for. `ready` stays open in it; it writes there.
[[noreturn]] void become_guard(std::vector<char*> argv, const char* log, int ready) {
  setsid();
  if (const pid_t pid = fork(); pid != 0) _exit(pid < 0 ? 1 : 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int out = open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  const int nowhere = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDIN_FILENO);
  if (out >= 0) {
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
  }
  fcntl(ready, F_SETFD, 0);
  execv(argv[0], argv.data());
  _exit(127);
}

}  // namespace

result::Result<void> start_guard(const config::CellConfig& config) {
  const std::filesystem::path log = config.state_dir / "guard.log";
  std::array<int, 2> ready{};
  if (pipe2(ready.data(), O_CLOEXEC) != 0) return failed(log, std::strerror(errno));
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::string> arguments = {(self.parent_path() / "stepwright-guard").string(),
                                        "guard",
                                        "--config",
                                        std::filesystem::absolute(config.file).string(),
                                        "--starter",
                                        std::to_string(getpid()),
                                        "--ready",
                                        std::to_string(ready[1])};
  for (const std::string& entry : config.overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(entry);
  }
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);

  const std::string log_text = log.string();
  const pid_t pid = fork();
  if (pid == 0) become_guard(std::move(argv), log_text.c_str(), ready[1]);
  close(ready[1]);
  if (pid > 0) waitpid(pid, nullptr, 0);
  // A byte: it watches. The end of the pipe without one: it could not.
  pollfd entry{ready[0], POLLIN, 0};
  char byte = 0;
  const bool watches = pid > 0 && poll(&entry, 1, kPatienceMs) == 1 && read(ready[0], &byte, 1) == 1;
  close(ready[0]);
  return watches ? result::Result<void>() : failed(log, "it does not start");
}

}  // namespace stepwright::cell_runtime
