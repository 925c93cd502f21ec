#include "runtime/native/native_engine.h"

#include <algorithm>
#include <cassert>
#include <new>
#include <utility>
#include <vector>

#include "runtime/native/internal/program_code.h"

namespace stepwright::native {

// What never changes once it is made.
struct NativeEngine::Code {
  ProgramCode program;
  std::vector<std::uint32_t> entry_costs;  // of each function: the bytes of its bytecode
  std::vector<bool> of_library;            // each function
  std::size_t context_bytes = 0;           // the context and all slots
  std::uint32_t memory_size = 0;
};

struct NativeEngine::Parts {
  explicit Parts(std::shared_ptr<const Code> c)
      : code(std::move(c)),
        memory((code->context_bytes + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t)) {
    new (memory.data()) Context{};
  }

  std::shared_ptr<const Code> code;  // of all engines that were made from one, whichever ends last
  std::vector<std::uint64_t> returns = std::vector<std::uint64_t>(kMostCalls);
  std::vector<std::uint64_t> memory;  // the context and all slots
  const bytecode::Interrupt* interrupt = nullptr;

  Context& context() { return *reinterpret_cast<Context*>(memory.data()); }

  // Back to the call that led out of what the user wrote.
  void leave_library(bytecode::Trap& trap) {
    std::uint32_t function = trap.function;
    const std::vector<CallSite>& calls = code->program.calls;
    const auto base = reinterpret_cast<std::uintptr_t>(code->program.memory.data());
    for (std::uint32_t i = 0; code->of_library[function] && i < context().return_count; ++i) {
      const std::size_t offset = returns[i] - base;
      const auto site = std::ranges::lower_bound(calls, offset, {}, &CallSite::offset);
      // The outermost call is that of the entry.
      if (site == calls.end() || site->offset != offset) return;
      function = trap.caller = site->function;
      trap.return_pc = site->return_pc;
    }
  }
};

NativeEngine::NativeEngine(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
NativeEngine::~NativeEngine() = default;

bool NativeEngine::supported() {
#if defined(__x86_64__) && defined(__linux__)
  return asmjit::CpuInfo::host().features().x86().hasSSE4_1();
#elif defined(__aarch64__) && defined(__linux__)
  return true;
#else
  return false;
#endif
}

result::Result<std::unique_ptr<NativeEngine>> NativeEngine::compile(const bytecode::Program& program) {
  if (!supported()) {
    return result::fail("R0010", {}, "this machine cannot run native code of Stepwright",
                        "native code needs an x86-64 processor with SSE4.1, or an AArch64 one, and Linux");
  }
  auto code = std::make_shared<Code>();
  const ProgramFacts facts(program);
  if (const asmjit::Error error = make_code(facts, code->program)) {
    return result::fail(
        "R0010", {}, std::string("no native code can be made: ") + asmjit::DebugUtils::errorAsString(error));
  }
  for (std::uint32_t i = 0; i < facts.function_count(); ++i) {
    const bytecode::FunctionRecord& record = facts.code(i).record;
    code->entry_costs.push_back(record.code_size);
    code->of_library.push_back((record.flags & bytecode::kFunctionOfLibrary) != 0);
  }
  code->context_bytes = facts.context_bytes();
  code->memory_size = program.memory_size();
  return std::unique_ptr<NativeEngine>(new NativeEngine(std::make_unique<Parts>(std::move(code))));
}

std::unique_ptr<NativeEngine> NativeEngine::another() const {
  return std::unique_ptr<NativeEngine>(new NativeEngine(std::make_unique<Parts>(parts_->code)));
}

bytecode::Trap NativeEngine::run(const bytecode::Invocation& invocation, std::span<std::byte> memory,
                                 std::uint64_t& budget) {
  const Code& code = *parts_->code;
  assert(memory.size() == code.memory_size);
  const std::uint32_t cost = code.entry_costs[invocation.function];
  if (cost > budget) return {bytecode::TrapCode::Watchdog, invocation.function, 0};
  Context& context = parts_->context();
  context.now_ns = invocation.now_ns;
  context.budget = bytecode::BudgetSlices::first(budget - cost, parts_->interrupt);
  context.slices = {budget - cost - context.budget, parts_->interrupt};
  context.memory = memory.data();
  context.memory_size = memory.size();
  context.self = memory.data() + invocation.instance;
  context.frames = invocation.frames;
  context.returns = parts_->returns.data();
  const std::uint32_t site = code.program.enter(&context, code.program.functions[invocation.function]);
  budget = context.budget + context.slices.reserve;
  if (site == 0) return {};
  bytecode::Trap trap = code.program.sites[site - 1];
  if (!trap) trap.code = static_cast<bytecode::TrapCode>(context.trap_code);
  parts_->leave_library(trap);
  return trap;
}

void NativeEngine::set_interrupt(const bytecode::Interrupt* interrupt) {
  parts_->interrupt = interrupt;
}

std::size_t NativeEngine::code_bytes() const {
  return parts_->code->program.memory.code_bytes();
}

}  // namespace stepwright::native
