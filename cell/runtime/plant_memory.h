#pragma once

// A simulated plant outlives the process that simulates it, as a real one would: the numbers that
// core::Plant::keep() gives are kept in a mapped file, so that a runtime that was killed finds its plant as
// it left it. A clean end removes the file: the next start is from the configured state. The file belongs
// into shared memory: one on a disk makes the scan wait while its page is written back.
//
// Threads: `keep` belongs to the scan thread; no heap, lock or system call in it. A kill at any instant
// leaves one complete state.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::cell_runtime {

class PlantMemory {
 public:
  // Opens or makes the file for a plant with so many numbers; what it held stays until the first `keep`.
  // Fails with R0079, also for a file of another user.
  [[nodiscard]] static result::Result<std::unique_ptr<PlantMemory>> open(const std::filesystem::path& file,
                                                                         std::size_t numbers);
  ~PlantMemory();
  PlantMemory(const PlantMemory&) = delete;
  PlantMemory& operator=(const PlantMemory&) = delete;

  // The state that a killed runtime left; nothing in a new file or in one of another size.
  std::optional<std::vector<double>> left_behind() const;
  // As many numbers as open() was told.
  void keep(std::span<const double> numbers);

 private:
  struct Record;
  PlantMemory(std::filesystem::path file, int descriptor, Record* record, std::size_t numbers);
  double* slot(std::uint32_t index) const;

  std::filesystem::path file_;
  int descriptor_;
  Record* record_;  // mapped; the two slots follow it
  std::size_t numbers_;
  bool owned_ = false;  // no other runtime had the file before
};

}  // namespace stepwright::cell_runtime
