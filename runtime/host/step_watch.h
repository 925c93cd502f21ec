#pragma once

// Compares the step bits of a program's charts with those of the scan before.
//
// Threads: the scan thread. Memory is taken once.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/bytecode/program.h"

namespace stepwright::host {

class StepWatch {
 public:
  explicit StepWatch(const bytecode::Program& program);

  // Takes this image as the one before, without reporting a change.
  void reset(std::span<const std::byte> image);
  // True if a step became active or inactive since the last call.
  bool changed(std::span<const std::byte> image);

 private:
  struct StepBit {
    std::uint32_t address;
    std::byte mask;
  };

  std::vector<StepBit> bits_;
  std::vector<std::byte> before_;
};

}  // namespace stepwright::host
