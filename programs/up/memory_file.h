#pragma once

// A file in memory, for what a command writes that this process is to look at first: no disk can be full
// there.
//
//   auto made = MemoryFile::make();
//   options.descriptors = {made->descriptor()};      // the command writes to MemoryFile::kInChild
//   ...
//   const std::string bytes = made->bytes();
//
// Threads: one.

#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::up {

class MemoryFile {
 public:
  // Where the first of its descriptors is in a child process.
  static constexpr const char* kInChild = "/dev/fd/3";

  // Fails with M0014.
  [[nodiscard]] static result::Result<MemoryFile> make();
  MemoryFile(MemoryFile&& other) noexcept;
  MemoryFile& operator=(MemoryFile&& other) noexcept;
  ~MemoryFile();

  int descriptor() const { return descriptor_; }
  // All of it.
  std::string bytes() const;

 private:
  explicit MemoryFile(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace stepwright::up
