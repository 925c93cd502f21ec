#include "tests/support/engine_program/engine_program.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "ladder/driver/compile.h"
#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::support {

reader::LoadedProgram compile_st(const std::string& text, std::span<const driver::Watcher> watchers) {
  auto output = driver::compile({.texts = {{"bench.st", text}}, .watchers = watchers});
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  auto loaded = reader::LoadedProgram::load(std::move(output->container), "bench");
  if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
  return std::move(*loaded);
}

EngineProgram::EngineProgram(reader::LoadedProgram loaded, EngineKind kind)
    : loaded_(std::move(loaded)),
      memory_(loaded_.program().memory_size()),
      stack_(loaded_.program().sizes().stack_slots),
      quick_code_(loaded_.program().container().section(bytecode::Section::Code).size()),
      info_(reader::ProgramInfo::read(loaded_.bytes()).value()) {
  const bytecode::Program& program = loaded_.program();
  if (kind == EngineKind::Vm) {
    engine_ = std::make_unique<vm::Interpreter>(program, stack_, quick_code_);
  } else {
    auto made = native::NativeEngine::compile(program);
    if (!made) throw std::runtime_error(result::to_string(made.error()));
    engine_ = std::move(*made);
  }
  const auto initial = program.container().section(bytecode::Section::InitialData);
  std::copy(initial.begin(), initial.end(), memory_.begin());
  for (std::uint32_t k = 0; k < program.container().count<bytecode::Section::ProgramCalls>(); ++k) {
    const auto call = program.container().record<bytecode::Section::ProgramCalls>(k);
    calls_.push_back({call.function, call.instance, 0, program.frames_of(0)});
  }
}

reader::Variable EngineProgram::variable(const std::string& path) const {
  const reader::Variable* const found = info_.find(path);
  if (found == nullptr) throw std::runtime_error("no variable " + path);
  return *found;
}

}  // namespace stepwright::support
