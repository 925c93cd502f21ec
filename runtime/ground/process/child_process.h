#pragma once

// A child process, ended and reaped when it goes out of scope.
//
//   auto child = ChildProcess::start({.arguments = {"/usr/bin/stepwright-link", "--config", file},
//                                     .log = folder / "link.log"});
//   while (!child->poll()) ...
//
// Threads: the one that started it, as the child gets SIGTERM when that one ends.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::process {

struct ExitStatus {
  int code = 0;         // exit code, or 128 + signal
  bool killed = false;  // by a signal
};

struct ChildOptions {
  std::vector<std::string> arguments = {};    // the program's path comes first
  std::filesystem::path log = {};             // what it prints is appended to this file; empty: to `output`
  int output = -1;                            // an open descriptor; -1: that of this process
  std::vector<std::string> environment = {};  // NAME=VALUE, in place of what this process has by that name
  std::filesystem::path folder = {};          // its working folder; empty: that of this process
  // Open descriptors that are 3, 4, ... in the child, which then gets no others of this process but the
  // standard streams.
  std::vector<int> descriptors = {};
  // Whatever it has started ends with it, also when this process is killed: a process stands over it
  // (subreaper.h), whose number pid() is. It is killed 2 s after ask_to_end() at the latest.
  bool with_descendants = false;
};

class ChildProcess {
 public:
  // Fails with M0001 if there is no such program. The child has a process group of its own, so that Ctrl-C
  // reaches this process only, and blocks no signals. It gets SIGTERM when this process dies.
  [[nodiscard]] static result::Result<ChildProcess> start(const ChildOptions& options);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  pid_t pid() const { return pid_; }
  // How it ended, or nothing while it runs. Reaps it; later calls repeat the answer.
  std::optional<ExitStatus> poll();
  // SIGTERM; does not wait.
  void ask_to_end();
  void kill_now();
  // SIGTERM, then SIGKILL if it does not end within `patience`.
  void end(std::chrono::milliseconds patience);

 private:
  ChildProcess(pid_t pid, int kill_signal) : pid_(pid), kill_signal_(kill_signal) {}
  void signal(int number);

  pid_t pid_ = -1;
  int kill_signal_;
  std::optional<ExitStatus> status_;
};

}  // namespace stepwright::process
