#pragma once

// The memory that engine and generated code share. Generated code uses no stack of its own but return
// addresses: the slots of every function lie at fixed places behind the context, as functions do not recurse.

#include <cstddef>
#include <cstdint>

namespace stepwright::native {

// What one run needs; the slots of all functions follow in the same block.
struct Context {
  std::int64_t now_ns;
  std::uint64_t budget;
  std::byte* memory;
  std::uint64_t memory_size;
  std::byte* self;
  std::uint64_t frames;         // the Ref of the task's frames
  std::uint64_t stack_pointer;  // where the entry was called, what a trap returns to
  std::uint32_t trap_code;      // of a trap whose site does not say why
};

inline constexpr std::uint32_t kSlotBytes = 8;
inline constexpr std::uint32_t kFirstSlot = sizeof(Context);

}  // namespace stepwright::native
