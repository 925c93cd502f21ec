#include "runtime/native/internal/program_code.h"

#include "runtime/native/internal/library_call.h"
#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

namespace x86 = asmjit::x86;

namespace {

constexpr x86::Gp kSaved[] = {x86::rbx, x86::rbp, x86::r12, x86::r13, x86::r14, x86::r15};

x86::Mem field(std::size_t offset) {
  return x86::ptr(kContext, static_cast<std::int32_t>(offset), 8);
}

// Calls leave nothing on the stack but return addresses, so that these are what lies there behind a trap.
void note_calls(Context* context, const std::uint64_t* top) {
  const auto* const end = reinterpret_cast<const std::uint64_t*>(context->stack_pointer);
  context->return_count = 0;
  for (; top != end && context->return_count < kMostCalls; ++top)
    context->returns[context->return_count++] = *top;
}

// Entry(context, function): sets the fixed registers, calls, and comes back here from traps as well.
void emit_entry(x86::Assembler& out, asmjit::Label entry, asmjit::Label trapped) {
  out.bind(entry);
  for (const x86::Gp& saved : kSaved) out.push(saved);
  out.sub(x86::rsp, 8);  // the stack is aligned where functions are called
  out.mov(kContext, x86::rdi);
  out.mov(kImage, field(offsetof(Context, memory)));
  out.mov(kSelf, field(offsetof(Context, self)));
  out.mov(kBudget, field(offsetof(Context, budget)));
  out.mov(field(offsetof(Context, stack_pointer)), x86::rsp);
  out.call(x86::rsi);
  out.xor_(x86::eax, x86::eax);
  const asmjit::Label leave = out.newLabel();
  out.bind(leave);
  out.mov(field(offsetof(Context, budget)), kBudget);
  out.mov(x86::rsp, field(offsetof(Context, stack_pointer)));
  out.add(x86::rsp, 8);
  for (auto saved = std::rbegin(kSaved); saved != std::rend(kSaved); ++saved) out.pop(*saved);
  out.ret();
  out.bind(trapped);
  out.mov(x86::r14d, x86::eax);
  out.mov(x86::rdi, kContext);
  out.mov(x86::rsi, x86::rsp);
  call_aligned(out, reinterpret_cast<std::uint64_t>(&note_calls));
  out.mov(x86::eax, x86::r14d);
  out.jmp(leave);
}

// Called from the middle of a function: every register that the platform's calls may change is kept.
void emit_refill(x86::Assembler& out, asmjit::Label refill) {
  constexpr x86::Gp kKept[] = {x86::rax, x86::rcx, x86::rdx, x86::rsi, x86::rdi,
                               x86::r8,  x86::r9,  x86::r10, x86::r11};
  constexpr std::int32_t kVectors = 16;
  constexpr std::int32_t kVectorBytes = 16;
  out.bind(refill);
  for (const x86::Gp& kept : kKept) out.push(kept);
  out.sub(x86::rsp, kVectors * kVectorBytes);
  for (std::int32_t i = 0; i < kVectors; ++i)
    out.movups(x86::ptr(x86::rsp, i * kVectorBytes), x86::xmm(static_cast<std::uint32_t>(i)));
  out.mov(field(offsetof(Context, budget)), kBudget);
  out.mov(x86::rdi, kContext);
  call_aligned(out, reinterpret_cast<std::uint64_t>(&refill_budget));
  out.mov(kBudget, field(offsetof(Context, budget)));
  for (std::int32_t i = 0; i < kVectors; ++i)
    out.movups(x86::xmm(static_cast<std::uint32_t>(i)), x86::ptr(x86::rsp, i * kVectorBytes));
  out.add(x86::rsp, kVectors * kVectorBytes);
  for (auto kept = std::rbegin(kKept); kept != std::rend(kKept); ++kept) out.pop(*kept);
  out.ret();
}

}  // namespace

asmjit::Error make_code(const ProgramFacts& facts, bool checked, ProgramCode& out) {
  asmjit::CodeHolder holder;
  FirstError errors;
  if (const asmjit::Error error = holder.init(asmjit::Environment::host())) return error;
  holder.setErrorHandler(&errors);
  x86::Assembler assembler(&holder);
  ConstantPool pool;
  ProgramWork work{facts,
                   assembler,
                   pool,
                   {},
                   assembler.newLabel(),
                   assembler.newLabel(),
                   out.sites,
                   out.calls,
                   checked ? &out.checks : nullptr};
  for (std::uint32_t i = 0; i < facts.function_count(); ++i) work.functions.push_back(assembler.newLabel());

  const asmjit::Label entry = assembler.newLabel();
  emit_entry(assembler, entry, work.trapped);
  for (std::uint32_t i = 0; i < facts.function_count(); ++i) {
    assembler.align(asmjit::AlignMode::kCode, 16);
    translate_function(work, i);
  }
  emit_refill(assembler,
              work.refill);  // behind the functions, whose places in their cache lines it leaves alone
  pool.emit(assembler);
  if (errors.first != asmjit::kErrorOk) return errors.first;

  return out.place(holder, entry, work.functions);
}

}  // namespace stepwright::native
