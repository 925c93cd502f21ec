#pragma once

// Which bytes each instruction of a function reads and writes, as far as it can be told before it runs: an
// address that comes from memory or from a parameter is unknown.

#include <cstdint>
#include <vector>

#include "runtime/native/internal/extent.h"
#include "runtime/native/internal/function_code.h"

namespace stepwright::native {

struct MemoryEffect {
  std::uint32_t item = 0;  // index of the instruction
  Extent extent;
  bytecode::MemType type = bytecode::MemType::U8;
  bool scalar = false;  // exactly one value of this type at a fixed address
  bool store = false;
};

std::vector<MemoryEffect> memory_effects(const bytecode::ContainerView& view, const FunctionCode& code,
                                         const FunctionPlaces& places);

}  // namespace stepwright::native
