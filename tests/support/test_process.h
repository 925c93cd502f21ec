#pragma once

// A program of the build as a child process of a test: its output in a file, killed at the latest with its
// object.

#include <signal.h>
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/patience.h"

namespace stepwright::support {

class TestProcess {
 public:
  // Runs `arguments[0]`; standard output and error go to `log`.
  TestProcess(const std::vector<std::string>& arguments, std::filesystem::path log);
  ~TestProcess();
  TestProcess(TestProcess&& other) noexcept;
  TestProcess& operator=(TestProcess&&) = delete;

  pid_t pid() const { return pid_; }
  void send(int signal) const { ::kill(pid_, signal); }
  // SIGKILL, and reaped.
  void kill();
  // Its exit code; none if it does not end within the patience, 128 + n if signal n ended it.
  std::optional<int> wait();
  std::string output() const;
  // True as soon as its output contains `text`.
  bool wait_for(const std::string& text) const;
  // Processor time that it has used so far, in seconds.
  double cpu_seconds() const;

 private:
  pid_t pid_ = -1;
  std::filesystem::path log_;
};

}  // namespace stepwright::support
