#include <cstring>

#include "runtime/native/internal/library_call.h"
#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::OperationInfo;
using bytecode::StackType;
using bytecode::TrapCode;
namespace x86 = asmjit::x86;

namespace {

x86::Mem budget_field() {
  return x86::ptr(kContext, static_cast<std::int32_t>(offsetof(Context, budget)), 8);
}

// The operands go to their slots, as wide as the interpreter has them; the result comes back in one.
void call_library(FunctionWork& work, LibraryCall function, std::uint32_t operation,
                  const OperationInfo& info) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  const auto count = static_cast<std::uint32_t>(std::strlen(info.pops));
  for (std::uint32_t i = 0; i < count; ++i) operands.pop_to_slot();
  operands.save_for_call();
  out.mov(budget_field(), kBudget);
  out.lea(x86::rdx, operands.slot_memory_at(operands.depth() + count));
  out.mov(x86::esi, operation);
  out.mov(x86::rdi, kContext);
  call_aligned(out, reinterpret_cast<std::uint64_t>(function));
  out.mov(kBudget, budget_field());
  out.test(x86::eax, x86::eax);
  out.jnz(work.trap(TrapCode::None));  // the context knows which
  if (*info.pushes != '\0') operands.push_slot(type_named(*info.pushes));
}

}  // namespace

void call_aligned(x86::Assembler& out, std::uint64_t function) {
  out.mov(gp64(kScratch), x86::rsp);
  out.and_(x86::rsp, -16);
  out.sub(x86::rsp, 16);
  out.mov(x86::ptr(x86::rsp), gp64(kScratch));
  out.mov(x86::rax, function);
  out.call(x86::rax);
  out.mov(x86::rsp, x86::ptr(x86::rsp));
}

bool translate_library(FunctionWork& work, const Instruction& in) {
  switch (in.opcode) {
    case Opcode::StringOp:
      return call_library(work, &run_string_op, in.a, bytecode::kStringOps[in.a]), true;
    case Opcode::Intrinsic:
      return call_library(work, &run_intrinsic, in.a, bytecode::kIntrinsics[in.a]), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
