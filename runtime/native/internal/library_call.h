#pragma once

// Entry points for generated code: operations that are written once for every engine (runtime/operations).
//
// Thread rule: as bytecode::Engine, in whose run they are called.

#include <cstdint>

#include "runtime/native/internal/context.h"
#include "runtime/operations/slot.h"

namespace stepwright::native {

// Runs an operation on the operands below `sp`, as the interpreter's stack would hold them, and leaves its
// result in their place. Not zero after a trap, which `trap_code` of the context names.
using LibraryCall = std::uint32_t (*)(Context* context, std::uint32_t operation, operations::Slot* sp);

std::uint32_t run_string_op(Context* context, std::uint32_t operation, operations::Slot* sp);
std::uint32_t run_intrinsic(Context* context, std::uint32_t operation, operations::Slot* sp);

// More of the budget for what `cost` of the context says, if there is more.
void refill_budget(Context* context);

}  // namespace stepwright::native
