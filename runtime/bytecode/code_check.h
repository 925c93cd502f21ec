#pragma once

// The third stage of verification: one function's code by abstract interpretation.
// One pass from the first to the last instruction; where ways join, their stacks must be equal. Code behind
// an unconditional jump that nothing has jumped to yet is checked as if it started with an empty stack.

#include <cstdint>
#include <span>

#include "runtime/bytecode/container_view.h"
#include "runtime/bytecode/verify_result.h"

namespace stepwright::bytecode {

struct CodeCheck {
  VerifyResult result;
  std::uint32_t max_stack = 0;  // the largest number of operand slots in use at once
};

// Scratch words that check_code needs for a function of this size.
constexpr std::uint64_t code_check_words(std::uint32_t code_size) {
  return std::uint64_t{code_size} * 5 + 12;
}

// Requires tables that check_tables accepted. Does not look at the declared max_stack.
CodeCheck check_code(const ContainerView& view, std::uint32_t function, std::span<std::uint32_t> scratch);

}  // namespace stepwright::bytecode
