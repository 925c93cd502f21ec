#include "cell/runtime/guard_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

namespace stepwright::cell_runtime {
namespace {

// One that cannot start ends, which is seen at once; only one that hangs is waited for so long.
constexpr int kPatienceMs = 60'000;

tl::unexpected<result::Diagnostics> failed(const std::filesystem::path& log, const std::string& why) {
  return result::fail("R0046", {log.string(), 0, 0}, "no guard watches: " + why,
                      "its own words are in this file; [guard] enabled = false runs without one");
}

std::filesystem::path log_of(const config::CellConfig& config) {
  return config.state_dir / "guard.log";
}

std::vector<std::string> arguments_of(const config::CellConfig& config, int ready) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::string> arguments = {
      (self.parent_path() / "stepwright-guard").string(), "guard",     "--config",
      std::filesystem::absolute(config.file).string(),    "--starter", std::to_string(getpid())};
  if (ready >= 0) arguments.insert(arguments.end(), {"--ready", std::to_string(ready)});
  for (const std::string& entry : config.overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(entry);
  }
  return arguments;
}

// A session of its own, so that no signal to the runtime's group reaches it; no signal is blocked in it.
class SpawnOptions {
 public:
  SpawnOptions(int log, int ready) {
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, log, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, log, STDERR_FILENO);
    // Onto itself: it stays open in the guard.
    if (ready >= 0) posix_spawn_file_actions_adddup2(&actions_, ready, ready);
  }
  ~SpawnOptions() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnOptions(const SpawnOptions&) = delete;
  SpawnOptions& operator=(const SpawnOptions&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
  posix_spawn_file_actions_t actions_;
};

}  // namespace

result::Result<pid_t> spawn_guard(const config::CellConfig& config, int ready) {
  const std::filesystem::path path = log_of(config);
  // Nobody else's file is written to by way of a link that somebody put here.
  const int log = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (log < 0) return failed(path, std::string("its log cannot be opened: ") + std::strerror(errno));
  std::vector<std::string> arguments = arguments_of(config, ready);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const SpawnOptions options(log, ready);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, argv[0], options.actions(), options.attributes(), argv.data(), environ);
  close(log);
  if (error != 0) return failed(path, std::strerror(error));
  return pid;
}

result::Result<pid_t> start_guard(const config::CellConfig& config) {
  std::array<int, 2> ready{};
  if (pipe2(ready.data(), O_CLOEXEC) != 0) return failed(log_of(config), std::strerror(errno));
  auto pid = spawn_guard(config, ready[1]);
  close(ready[1]);
  // A byte: it watches. The end of the pipe without one: it could not.
  pollfd entry{ready[0], POLLIN, 0};
  char byte = 0;
  const bool watches = pid && poll(&entry, 1, kPatienceMs) == 1 && read(ready[0], &byte, 1) == 1;
  close(ready[0]);
  if (!pid || watches) return pid;
  waitpid(*pid, nullptr, WNOHANG);
  return failed(log_of(config), "it does not start");
}

}  // namespace stepwright::cell_runtime
