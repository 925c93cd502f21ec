#pragma once

// Pipe from a process: what it prints, line by line, as it comes.
//
//   auto pipe = LinePipe::open();
//   auto child = ChildProcess::start({.arguments = ..., .output = pipe->writing_end()});
//   for (const std::string& line : pipe->lines()) ...
//
// Threads: one. Nothing blocks. The pipe outlives the process: those that it has started itself go on writing
// to it, and so does the process that takes its place. A line that is longer than 16 KiB is cut into several.

#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::processes {

class LinePipe {
 public:
  LinePipe() = default;
  // Fails with M0014 if the system gives none.
  [[nodiscard]] static result::Result<LinePipe> open();
  ~LinePipe();
  LinePipe(LinePipe&& other) noexcept;
  LinePipe& operator=(LinePipe&& other) noexcept;

  int writing_end() const { return writing_; }
  // To poll.
  int descriptor() const { return reading_; }

  // The whole lines that have come, without their ends.
  std::vector<std::string> lines();
  // The same, and what stands behind them: the process has ended.
  std::vector<std::string> last_lines();

 private:
  int reading_ = -1;
  int writing_ = -1;
  std::string begun_;  // a line that is not whole yet
};

}  // namespace stepwright::processes
