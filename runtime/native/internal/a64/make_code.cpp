#include "runtime/native/internal/program_code.h"

#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native {

namespace a64 {

namespace {

constexpr std::int32_t kSavedBytes = 48;

Mem field(std::size_t offset) {
  return ptr(kContext, static_cast<std::int32_t>(offset));
}

// Every function leaves a pair on the stack, whose second half is the return address.
void note_calls(Context* context, const std::uint64_t* top) {
  const auto* const end = reinterpret_cast<const std::uint64_t*>(context->stack_pointer);
  context->return_count = 0;
  for (; top != end && context->return_count < kMostCalls; top += 2)
    context->returns[context->return_count++] = top[1];
}

// Entry(context, function): sets the fixed registers, calls, and comes back here from traps as well.
void emit_entry(Assembler& out, asmjit::Label entry, asmjit::Label trapped) {
  const GpX stack(GpX::kIdSp);
  out.bind(entry);
  out.stp(GpX(29), GpX(30), ptr_pre(stack, -kSavedBytes));
  out.stp(GpX(19), GpX(20), ptr(stack, 16));
  out.stp(GpX(21), GpX(22), ptr(stack, 32));
  out.mov(kContext, GpX(0));
  out.ldr(kImage, field(offsetof(Context, memory)));
  out.ldr(kSelf, field(offsetof(Context, self)));
  out.ldr(kBudget, field(offsetof(Context, budget)));
  out.mov(x(kScratch), stack);
  out.str(x(kScratch), field(offsetof(Context, stack_pointer)));
  out.blr(GpX(1));
  out.mov(GpW(0), 0);
  const asmjit::Label leave = out.newLabel();
  out.bind(leave);
  out.str(kBudget, field(offsetof(Context, budget)));
  out.ldr(x(kScratch), field(offsetof(Context, stack_pointer)));
  out.mov(stack, x(kScratch));
  out.ldp(GpX(21), GpX(22), ptr(stack, 32));
  out.ldp(GpX(19), GpX(20), ptr(stack, 16));
  out.ldp(GpX(29), GpX(30), ptr_post(stack, kSavedBytes));
  out.ret(GpX(30));
  out.bind(trapped);
  out.str(GpX(0), ptr_pre(stack, -16));
  out.mov(GpX(0), kContext);
  out.add(GpX(1), stack, 16);
  out.mov(x(kScratch), asmjit::Imm(reinterpret_cast<std::uint64_t>(&note_calls)));
  out.blr(x(kScratch));
  out.ldr(GpX(0), ptr_post(stack, 16));
  out.b(leave);
}

}  // namespace

}  // namespace a64

asmjit::Error make_code(const ProgramFacts& facts, ProgramCode& out) {
  asmjit::CodeHolder holder;
  FirstError errors;
  if (const asmjit::Error error = holder.init(asmjit::Environment::host())) return error;
  holder.setErrorHandler(&errors);
  a64::Assembler assembler(&holder);
  a64::ProgramWork work{facts, assembler, {}, assembler.newLabel(), out.sites, out.calls};
  for (std::uint32_t i = 0; i < facts.function_count(); ++i) work.functions.push_back(assembler.newLabel());
  const asmjit::Label entry = assembler.newLabel();
  a64::emit_entry(assembler, entry, work.trapped);
  for (std::uint32_t i = 0; i < facts.function_count(); ++i) a64::translate_function(work, i);
  if (errors.first != asmjit::kErrorOk) return errors.first;
  return out.place(holder, entry, work.functions);
}

}  // namespace stepwright::native
