#pragma once

// Loops without calls, and the variables that they keep in registers: scalars at fixed addresses that nothing
// else in the loop can touch. Loaded before the loop, written back wherever it is left: at its end, at jumps
// out of it, at Return, at traps.

#include <cstdint>
#include <vector>

#include "runtime/native/internal/program_facts.h"
#include "runtime/native/internal/x86/operands.h"

namespace stepwright::native {

struct Loop {
  std::uint32_t first = 0;  // index of the instruction that the loop starts with; entered nowhere else
  std::uint32_t last = 0;   // of the last jump back to it
  std::vector<Pinned> variables;

  bool holds(std::uint32_t item) const { return item >= first && item <= last; }
};

// Loops that do not contain each other, by `first`.
std::vector<Loop> plan_loops(const ProgramFacts& program, std::uint32_t function);

// Copies up to this size are made in place; larger ones call the library.
inline constexpr std::uint32_t kLargestInlineCopy = 64;

}  // namespace stepwright::native
