#include "runtime/host/engine_choice.h"

#include <utility>
#include <vector>

#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::host {

namespace {

// The interpreter and the memory that it takes; the code is shared with those that were made from it.
class HostInterpreter final : public bytecode::Engine {
 public:
  explicit HostInterpreter(const bytecode::Program& program)
      : stack_(program.sizes().stack_slots),
        quick_code_(std::make_shared<std::vector<std::byte>>(
            program.container().section(bytecode::Section::Code).size())),
        interpreter_(program, stack_, *quick_code_) {}
  HostInterpreter(const HostInterpreter& other)
      : Engine(),
        stack_(other.stack_.size()),
        quick_code_(other.quick_code_),
        interpreter_(other.interpreter_.another(stack_)) {}
  HostInterpreter& operator=(const HostInterpreter&) = delete;

  bytecode::Trap run(const bytecode::Invocation& invocation, std::span<std::byte> memory,
                     std::uint64_t& budget) override {
    return interpreter_.run(invocation, memory, budget);
  }
  void set_interrupt(const bytecode::Interrupt* interrupt) override { interpreter_.set_interrupt(interrupt); }

 private:
  std::vector<std::uint64_t> stack_;
  std::shared_ptr<std::vector<std::byte>> quick_code_;  // of several threads; nobody changes it any more
  vm::Interpreter interpreter_;
};

using Engines = std::vector<std::unique_ptr<bytecode::Engine>>;

Engines on_native_code(std::unique_ptr<native::NativeEngine> first, std::size_t count) {
  Engines engines;
  for (std::size_t i = 1; i < count; ++i) engines.push_back(first->another());
  engines.push_back(std::move(first));
  return engines;
}

Engines on_interpreters(const bytecode::Program& program, std::size_t count) {
  auto first = std::make_unique<HostInterpreter>(program);
  Engines engines;
  for (std::size_t i = 1; i < count; ++i) engines.push_back(std::make_unique<HostInterpreter>(*first));
  engines.push_back(std::move(first));
  return engines;
}

}  // namespace

result::Result<Engines> make_engines(EngineKind kind, const bytecode::Program& program, std::size_t count) {
  if (kind != EngineKind::Vm) {
    auto compiled = native::NativeEngine::compile(program);
    if (compiled) return on_native_code(std::move(*compiled), count);
    if (kind == EngineKind::Native) return result::forward(compiled);
  }
  return on_interpreters(program, count);
}

result::Result<std::unique_ptr<bytecode::Engine>> make_engine(EngineKind kind,
                                                              const bytecode::Program& program) {
  auto engines = make_engines(kind, program, 1);
  if (!engines) return result::forward(engines);
  return std::move(engines->front());
}

}  // namespace stepwright::host
