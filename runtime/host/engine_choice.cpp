#include "runtime/host/engine_choice.h"

#include <utility>

#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::host {

result::Result<std::unique_ptr<bytecode::Engine>> make_engine(EngineKind kind,
                                                              const bytecode::Program& program,
                                                              std::span<std::uint64_t> stack) {
  if (kind != EngineKind::Vm) {
    auto compiled = native::NativeEngine::compile(program);
    if (compiled) return std::unique_ptr<bytecode::Engine>(std::move(*compiled));
    if (kind == EngineKind::Native) return result::forward(compiled);
  }
  return std::unique_ptr<bytecode::Engine>(std::make_unique<vm::Interpreter>(program, stack));
}

}  // namespace stepwright::host
