#pragma once

// The program that runs, as the source has last seen it: written by the thread that looks at the cell, read
// by those that act on it.
//
// Threads: every function from any.

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::hmi {

struct KnownProgram {
  std::string digest;
  reader::ProgramInfo info;
  std::string document;  // of its container, as it came; empty: it has none
  std::shared_ptr<const std::vector<std::byte>> container;  // shared with whoever compares it with another
};

class RunningProgram {
 public:
  void set(std::shared_ptr<const KnownProgram> program) {
    const std::lock_guard lock(mutex_);
    program_ = std::move(program);
  }
  // Null before the first one. Shared: whoever acts may still read it while another one arrives.
  std::shared_ptr<const KnownProgram> get() const {
    const std::lock_guard lock(mutex_);
    return program_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const KnownProgram> program_;
};

}  // namespace stepwright::hmi
