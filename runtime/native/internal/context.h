#pragma once

// The memory that engine and generated code share. Generated code uses no stack of its own but return
// addresses: the slots of every function lie at fixed places behind the context, as functions do not recurse.

#include <cstddef>
#include <cstdint>

#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/interrupt.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::native {

// State of one run; the slots of all functions follow in the same block.
struct Context {
  std::int64_t now_ns;
  std::uint64_t budget;
  std::byte* memory;
  std::uint64_t memory_size;
  std::byte* self;
  std::uint64_t frames;         // the Ref of the task's frames
  std::uint64_t stack_pointer;  // where the entry was called, what a trap returns to
  std::uint64_t* returns;       // behind a trap the return addresses of all calls, the innermost first
  std::uint32_t return_count;   // of them; there is room for kMostCalls
  std::uint32_t trap_code;      // of a trap whose site does not say why
  std::uint8_t condition;       // a comparison's result, while a register is made free for it
  std::uint32_t cost;           // what the slice of the budget is too small for
  std::uint32_t broken_check;   // of checked code: the number of the first check that failed; 0: none
  bytecode::BudgetSlices slices;
};

// As deep as the verifier lets calls go, and the call of the entry.
inline constexpr std::uint32_t kMostCalls = bytecode::kMaxCallDepth + 1;

inline constexpr std::uint32_t kSlotBytes = 8;

// How a value of this type lies in a slot.
constexpr bytecode::MemType slot_memory(bytecode::StackType type) {
  using bytecode::MemType;
  constexpr MemType kTypes[] = {MemType::Bool, MemType::I32, MemType::I64,
                                MemType::F32,  MemType::F64, MemType::I64};
  return kTypes[static_cast<std::uint8_t>(type)];
}

inline constexpr std::uint32_t kFirstSlot = sizeof(Context);

}  // namespace stepwright::native
