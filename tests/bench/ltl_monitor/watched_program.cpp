#include "tests/bench/ltl_monitor/watched_program.h"

#include <algorithm>
#include <stdexcept>

#include "ladder/driver/compile.h"
#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::bench {

namespace {

constexpr const char* kPlant = R"(PROGRAM main
VAR p1, p2, p3, p4, p5, p6, p7, p8 : BOOL; scans : UDINT; END_VAR
scans := scans + 1;
END_PROGRAM
)";

reader::LoadedProgram compiled(std::span<const driver::Watcher> watchers) {
  auto output = driver::compile({.texts = {{"main.st", kPlant}}, .watchers = watchers});
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  auto loaded = reader::LoadedProgram::load(std::move(output->container), "bench");
  if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
  return std::move(*loaded);
}

}  // namespace

WatchedProgram::WatchedProgram(EngineKind kind, std::span<const driver::Watcher> watchers)
    : loaded_(compiled(watchers)),
      memory_(loaded_.program().memory_size()),
      stack_(loaded_.program().sizes().stack_slots),
      quick_code_(loaded_.program().container().section(bytecode::Section::Code).size()) {
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
  const auto info = reader::ProgramInfo::read(loaded_.bytes()).value();
  places_ = info.find("main.p1")->address;
  if (info.find("main.p8")->address != places_ + kPlaces - 1)
    throw std::runtime_error("the places do not lie side by side");
  if (watchers.empty()) {
    reset_ = verdict_ = places_;
    return;
  }
  reset_ = info.find(watchers.front().name + ".Reset")->address;
  verdict_ = info.find(watchers.front().name + ".Verdict")->address;
}

}  // namespace stepwright::bench
