#include "runtime/native/internal/library_call.h"

#include "runtime/operations/intrinsics.h"
#include "runtime/operations/string_ops.h"

namespace stepwright::native {

using bytecode::TrapCode;

std::uint32_t run_string_op(Context* context, std::uint32_t operation, operations::Slot* sp) {
  std::uint64_t left = context->budget + context->slices.reserve;
  const TrapCode code = operations::call_string_op(static_cast<bytecode::StringOpId>(operation), sp,
                                                   {context->memory, context->memory_size}, left);
  context->trap_code = static_cast<std::uint32_t>(code);
  if (code != TrapCode::None) return 1;
  context->budget = context->slices.after(context->budget, left);
  return 0;
}

void refill_budget(Context* context) {
  context->budget = context->slices.refill(context->budget, context->cost);
}

std::uint32_t run_intrinsic(Context* context, std::uint32_t operation, operations::Slot* sp) {
  context->trap_code = static_cast<std::uint32_t>(TrapCode::BadArgument);
  return operations::call_intrinsic(static_cast<bytecode::IntrinsicId>(operation), sp) ? 0 : 1;
}

}  // namespace stepwright::native
