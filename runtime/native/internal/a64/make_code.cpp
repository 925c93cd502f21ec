#include "runtime/native/internal/program_code.h"

#include "runtime/native/internal/a64/translate.h"
#include "runtime/native/internal/library_call.h"

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

// Called from the middle of a function: every register of values that the platform's calls may change is
// kept.
void emit_refill(Assembler& out, asmjit::Label refill) {
  constexpr std::uint32_t kGeneral = 16;  // x0 to x15; behind them only x30
  constexpr std::int32_t kPair = 16;
  const GpX stack(GpX::kIdSp);
  const auto vectors = [](const auto& each) {
    for (std::uint32_t i = 0; i < 32; i += 2) {
      if (i < 8 || i >= 16) each(VecD(i), VecD(i + 1));
    }
  };
  constexpr std::int32_t kVectors = 24;
  constexpr std::int32_t kBytes = (kGeneral + 2 + kVectors) * 8;
  out.bind(refill);
  out.sub(stack, stack, kBytes);
  std::int32_t at = 0;
  for (std::uint32_t i = 0; i < kGeneral; i += 2, at += kPair) out.stp(x(i), x(i + 1), ptr(stack, at));
  out.str(GpX(30), ptr(stack, at));
  at += kPair;
  vectors([&](VecD first, VecD second) {
    out.stp(first, second, ptr(stack, at));
    at += kPair;
  });
  out.str(kBudget, field(offsetof(Context, budget)));
  out.mov(GpX(0), kContext);
  out.mov(x(kScratch), asmjit::Imm(reinterpret_cast<std::uint64_t>(&refill_budget)));
  out.blr(x(kScratch));
  out.ldr(kBudget, field(offsetof(Context, budget)));
  at = 0;
  for (std::uint32_t i = 0; i < kGeneral; i += 2, at += kPair) out.ldp(x(i), x(i + 1), ptr(stack, at));
  out.ldr(GpX(30), ptr(stack, at));
  at += kPair;
  vectors([&](VecD first, VecD second) {
    out.ldp(first, second, ptr(stack, at));
    at += kPair;
  });
  out.add(stack, stack, kBytes);
  out.ret(GpX(30));
}

}  // namespace

}  // namespace a64

asmjit::Error make_code(const ProgramFacts& facts, bool, ProgramCode& out) {
  asmjit::CodeHolder holder;
  FirstError errors;
  if (const asmjit::Error error = holder.init(asmjit::Environment::host())) return error;
  holder.setErrorHandler(&errors);
  a64::Assembler assembler(&holder);
  a64::ProgramWork work{facts,     assembler, {}, assembler.newLabel(), assembler.newLabel(),
                        out.sites, out.calls};
  for (std::uint32_t i = 0; i < facts.function_count(); ++i) work.functions.push_back(assembler.newLabel());
  const asmjit::Label entry = assembler.newLabel();
  a64::emit_entry(assembler, entry, work.trapped);
  a64::emit_refill(assembler, work.refill);
  for (std::uint32_t i = 0; i < facts.function_count(); ++i) a64::translate_function(work, i);
  if (errors.first != asmjit::kErrorOk) return errors.first;
  return out.place(holder, entry, work.functions);
}

}  // namespace stepwright::native
