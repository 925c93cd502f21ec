#include "runtime/host/engine_choice.h"

#include <utility>
#include <vector>

#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::host {

namespace {

// The interpreter and the memory that it takes.
class HostInterpreter final : public bytecode::Engine {
 public:
  explicit HostInterpreter(const bytecode::Program& program)
      : stack_(program.sizes().stack_slots),
        quick_code_(program.container().section(bytecode::Section::Code).size()),
        interpreter_(program, stack_, quick_code_) {}

  bytecode::Trap run(const bytecode::Invocation& invocation, std::span<std::byte> memory,
                     std::uint64_t& budget) override {
    return interpreter_.run(invocation, memory, budget);
  }
  void set_interrupt(const bytecode::Interrupt* interrupt) override { interpreter_.set_interrupt(interrupt); }

 private:
  std::vector<std::uint64_t> stack_;
  std::vector<std::byte> quick_code_;
  vm::Interpreter interpreter_;
};

}  // namespace

result::Result<std::unique_ptr<bytecode::Engine>> make_engine(EngineKind kind,
                                                              const bytecode::Program& program) {
  if (kind != EngineKind::Vm) {
    auto compiled = native::NativeEngine::compile(program);
    if (compiled) return std::unique_ptr<bytecode::Engine>(std::move(*compiled));
    if (kind == EngineKind::Native) return result::forward(compiled);
  }
  return std::unique_ptr<bytecode::Engine>(std::make_unique<HostInterpreter>(program));
}

}  // namespace stepwright::host
