#include "tests/st/machine.h"

#include <stdexcept>

#include "runtime/image/no_io.h"
#include "runtime/image/process_image.h"
#include "runtime/native/native_engine.h"
#include "runtime/scan/no_clock.h"
#include "tests/st/literal.h"

namespace stepwright::st_test {

namespace {

std::unique_ptr<bytecode::Engine> make_engine(const bytecode::Program& program, EngineKind kind) {
  auto engine = host::make_engine(kind, program);
  if (!engine) throw std::runtime_error(result::to_string(engine.error()));
  return std::move(*engine);
}

}  // namespace

std::vector<EngineKind> engines() {
  if (native::NativeEngine::supported()) return {EngineKind::Vm, EngineKind::Native};
  return {EngineKind::Vm};
}

const char* name_of(EngineKind kind) {
  return kind == EngineKind::Vm ? "vm" : "native";
}

struct Machine::Parts {
  Parts(const reader::LoadedProgram& loaded, EngineKind kind)
      : info(reader::ProgramInfo::read(loaded.bytes()).value()),
        memory(loaded.program().memory_size()),
        image(memory, scan::layout_of(loaded.program())),
        engine(make_engine(loaded.program(), kind)),
        safe_outputs(image.outputs().size()),
        cycle(loaded.program(), *engine, image, safe_outputs, io, clock, {}) {
    cycle.start({});
  }

  reader::ProgramInfo info;
  std::vector<std::byte> memory;
  image::ProcessImage image;
  std::unique_ptr<bytecode::Engine> engine;
  std::vector<std::byte> safe_outputs;
  image::NoIo io;
  scan::NoClock clock;
  scan::ScanCycle cycle;
};

Machine::Machine(const reader::LoadedProgram& program, EngineKind kind)
    : parts_(std::make_unique<Parts>(program, kind)) {}

Machine::~Machine() = default;

void Machine::restart_after_trap() {
  scan::ScanCycle& cycle = parts_->cycle;
  if (cycle.state() == scan::ScanState::Trapped)
    cycle.start({cycle.next_time_ns(), cycle.scan(), cycle.trace_hash()});
}

scan::ScanReport Machine::scan() {
  return parts_->cycle.run_scan();
}

reader::Variable Machine::find(const std::string& path) const {
  const reader::Variable* variable = parts_->info.find(path);
  if (variable == nullptr) variable = parts_->info.find("main." + path);
  if (variable == nullptr) throw std::runtime_error("no variable " + path);
  return *variable;
}

void Machine::set(const std::string& path, const std::string& value) {
  write_literal(find(path), value, parts_->memory);
}

bool Machine::equals(const std::string& path, const std::string& expected) const {
  return equals_literal(find(path), expected, parts_->memory);
}

std::string Machine::shown(const std::string& path) const {
  return shown_value(find(path), parts_->memory);
}

std::span<const std::byte> Machine::image() const {
  return parts_->image.bytes();
}

}  // namespace stepwright::st_test
