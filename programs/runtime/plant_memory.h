#pragma once

// A simulated plant outlives the process that simulates it, as a real one would: where the vehicle stands and
// what is in the tanks is kept in a mapped file, so that a runtime that was killed finds its plant as it left
// it. A clean end removes the file: the next start is from the configured state. The file belongs into shared
// memory: one on a disk makes the scan wait while its page is written back.
//
// Threads: `keep` belongs to the scan thread; no heap, lock or system call in it. A kill at any instant
// leaves one complete state.

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "runtime/result/result.h"

namespace stepwright::cell_runtime {

class PlantMemory {
 public:
  // Position in m, then the levels of f1, v1, a1 and a2 in percent.
  using State = std::array<double, 5>;

  // Opens or makes the file; what it held stays until the first `keep`. Fails with R0001,
  // also for a file of another user.
  [[nodiscard]] static result::Result<std::unique_ptr<PlantMemory>> open(const std::filesystem::path& file);
  ~PlantMemory();
  PlantMemory(const PlantMemory&) = delete;
  PlantMemory& operator=(const PlantMemory&) = delete;

  // The state that a killed runtime left; nothing in a new file or in one that makes no sense.
  std::optional<State> left_behind() const;
  void keep(const State& state);

 private:
  struct Record;
  PlantMemory(std::filesystem::path file, int descriptor, Record* record);

  std::filesystem::path file_;
  int descriptor_;
  Record* record_;      // mapped
  bool owned_ = false;  // no other runtime had the file before
};

}  // namespace stepwright::cell_runtime
