#pragma once

// A shared-memory I/O area, mapped: a file in /dev/shm that stays when its processes go, for this user only.
// The first process creates it. Its locks are the kernel's and end with the process that holds them: a lock
// that is free proves that its last holder can write no more.
//
//   auto area = IoArea::open("press", 64, 64);          // /dev/shm/stepwright-io-press
//   if ((*area)->try_lock(AreaLock::Lease)) ...
//
// Threads: any; the locks belong to this object. Fails with R0042 (the system refuses it), R0043 (an area of
// other sizes is in use).

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "runtime/io_memory/area_format.h"
#include "runtime/io_memory/twin_block.h"

namespace stepwright::io_memory {

// Letters, digits, '-', '_' and '.', 64 of them at most.
bool is_area_name(std::string_view name);
std::filesystem::path area_path(std::string_view name);

// CLOCK_MONOTONIC, as all instants of the area; no system call.
std::int64_t monotonic_ns();

class IoArea {
 public:
  // An area that nobody has open gives way to one of the sizes that are asked for; this one keeps its sizes
  // for as long as it lives. Requires a proper name and sizes from 1 to kMaxAreaBytes.
  [[nodiscard]] static result::Result<std::unique_ptr<IoArea>> open(const std::string& name,
                                                                    std::uint32_t input_bytes,
                                                                    std::uint32_t output_bytes);
  ~IoArea();
  IoArea(const IoArea&) = delete;
  IoArea& operator=(const IoArea&) = delete;

  AreaHeader& header() { return *reinterpret_cast<AreaHeader*>(memory_); }
  TwinBlock inputs() { return {memory_ + header().inputs_at, header().input_bytes}; }
  TwinBlock outputs() { return {memory_ + header().outputs_at, header().output_bytes}; }
  const std::filesystem::path& path() const { return path_; }

  // One system call each. False if another process, or another object of this one, holds the lock.
  bool try_lock(AreaLock lock);
  void unlock(AreaLock lock);
  bool locked_elsewhere(AreaLock lock) const;

 private:
  IoArea(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  bool in_use() const;
  [[nodiscard]] result::Result<void> map(std::uint32_t input_bytes, std::uint32_t output_bytes);

  std::filesystem::path path_;
  int descriptor_;
  std::byte* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace stepwright::io_memory
