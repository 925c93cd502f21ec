#pragma once

// The right to be a file's only writer, kept by the kernel for as long as the object lives: it ends with the
// process, however that ends.
//
//   auto lock = FileLock::take("history.db");      // locks history.db.lock beside it
//
// Thread rule: any, one at a time.

#include <filesystem>
#include <utility>

#include "runtime/ground/result/result.h"

namespace stepwright::storage {

class FileLock {
 public:
  // Does not wait. S0004: another process has it; S0001: the lock's file cannot be made.
  [[nodiscard]] static result::Result<FileLock> take(const std::filesystem::path& file);
  ~FileLock();
  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace stepwright::storage
