#pragma once

// The fourth stage of verification: the call graph. Calls may not recurse, so that the deepest call chain and
// the stack that it needs are known before anything runs.

#include <cstdint>
#include <span>

#include "runtime/bytecode/container_view.h"
#include "runtime/bytecode/verify_result.h"

namespace stepwright::bytecode {

// Slots beside locals and operands that the interpreter keeps per call: two for the caller, one where the top
// of an empty stack lies.
inline constexpr std::uint32_t kFrameSlots = 3;

struct StackNeed {
  VerifyResult result;            // Recursion, or TooLarge
  std::uint32_t stack_slots = 0;  // of the deepest chain that starts at a program call
  std::uint32_t call_depth = 0;   // functions in the longest chain
};

constexpr std::uint64_t stack_need_words(std::uint32_t function_count) {
  return std::uint64_t{function_count} * 2;
}

// Requires code that check_code accepted and the right max_stack in every function record; scratch of
// stack_need_words.
StackNeed compute_stack_need(const ContainerView& view, std::span<std::uint32_t> scratch);

}  // namespace stepwright::bytecode
