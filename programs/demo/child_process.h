#pragma once

// A child process with its output in a file; ended and reaped when it goes out of scope.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::demo {

struct ExitStatus {
  int code = 0;         // exit code, or 128 + signal
  bool killed = false;  // by a signal
};

class ChildProcess {
 public:
  // Starts `arguments[0]`; what it prints is appended to `log`. The child gets SIGTERM when this process
  // dies.
  [[nodiscard]] static result::Result<ChildProcess> start(const std::vector<std::string>& arguments,
                                                          const std::filesystem::path& log);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  pid_t pid() const { return pid_; }
  // How it ended, or nothing while it runs. Reaps it; later calls repeat the answer.
  std::optional<ExitStatus> poll();
  // SIGTERM, then SIGKILL if it does not end within `patience`.
  void end(std::chrono::milliseconds patience);

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}
  pid_t pid_ = -1;
  std::optional<ExitStatus> status_;
};

}  // namespace stepwright::demo
