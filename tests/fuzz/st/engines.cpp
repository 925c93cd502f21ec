#include "tests/fuzz/st/engines.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::st_fuzz {

namespace {

constexpr std::uint64_t kBudget = 2'000'000;
constexpr std::int64_t kInterval = 10'000'000;

reader::LoadedProgram load(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"fuzz.st", text});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  auto loaded = reader::LoadedProgram::load(std::move(output->container), "fuzz");
  if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
  return std::move(*loaded);
}

std::string shown(const bytecode::Trap& trap) {
  return std::string(bytecode::name_of(trap.code)) + " in " + std::to_string(trap.function) + " at " +
         std::to_string(trap.pc);
}

}  // namespace

struct Engines::Parts {
  explicit Parts(const std::string& text)
      : program(load(text)),
        info(reader::ProgramInfo::read(program.bytes()).value()),
        stack(program.program().sizes().stack_slots),
        quick_code(program.program().container().section(bytecode::Section::Code).size()) {
    engines.push_back(std::make_unique<vm::Interpreter>(program.program(), stack));
    engines.push_back(std::make_unique<vm::Interpreter>(program.program(), stack, quick_code));
    if (has_native()) {
      auto native = native::NativeEngine::compile(program.program());
      if (!native) throw std::runtime_error(result::to_string(native.error()));
      engines.push_back(std::move(*native));
    }
    const auto initial = program.program().container().section(bytecode::Section::InitialData);
    std::vector<std::byte> memory(program.program().memory_size());
    std::ranges::copy(initial, memory.begin());
    memories.assign(engines.size(), memory);
    const auto& view = program.program().container();
    const auto call =
        view.record<bytecode::Section::ProgramCalls>(view.record<bytecode::Section::Tasks>(0).first_call);
    invocation = {call.function, call.instance, 0, program.program().frames_of(0)};
  }

  const reader::Variable& find(const std::string& path) const {
    const reader::Variable* found = info.find(path);
    if (found == nullptr) throw std::runtime_error("no variable " + path);
    return *found;
  }

  reader::LoadedProgram program;
  reader::ProgramInfo info;
  std::vector<std::uint64_t> stack;
  std::vector<std::byte> quick_code;
  std::vector<std::unique_ptr<bytecode::Engine>> engines;
  std::vector<std::vector<std::byte>> memories;
  bytecode::Invocation invocation;
  bytecode::Trap trap;
};

Engines::Engines(const std::string& text) : parts_(std::make_unique<Parts>(text)) {}
Engines::~Engines() = default;

void Engines::set(const std::string& path, Scalar type, std::uint64_t bits) {
  const reader::Variable& variable = parts_->find(path);
  for (auto& memory : parts_->memories) std::memcpy(&memory[variable.address], &bits, bits_of(type) / 8);
}

std::uint64_t Engines::get(const std::string& path, Scalar type) const {
  const reader::Variable& variable = parts_->find(path);
  const std::vector<std::byte>& memory = parts_->memories.front();
  if (variable.bit != bytecode::kNoBit)
    return (std::to_integer<std::uint64_t>(memory[variable.address]) >> variable.bit) & 1;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &memory[variable.address], bits_of(type) / 8);
  return extended(type, bits);
}

std::string Engines::scan() {
  Parts& p = *parts_;
  std::uint64_t left = kBudget;
  p.trap = p.engines[0]->run(p.invocation, p.memories[0], left);
  std::string out;
  for (std::size_t i = 1; i < p.engines.size(); ++i) {
    std::uint64_t other_left = kBudget;
    const std::string name = i == 1 ? "quick" : "native";
    const bytecode::Trap trap = p.engines[i]->run(p.invocation, p.memories[i], other_left);
    if (trap != p.trap) out += "trap: " + shown(p.trap) + ", " + name + ": " + shown(trap) + "\n";
    if (left != other_left)
      out += "budget left: " + std::to_string(left) + ", " + name + ": " + std::to_string(other_left) + "\n";
    // Frames have no value between scans.
    for (std::size_t at = 0; at < p.program.program().image_size(); ++at) {
      if (p.memories[0][at] == p.memories[i][at]) continue;
      out += "byte " + std::to_string(at) + " of the image differs in " + name + "\n";
      break;
    }
  }
  p.invocation.now_ns += kInterval;
  return out;
}

const bytecode::Trap& Engines::trap() const {
  return parts_->trap;
}

std::string Engines::trap_place() const {
  const result::Location where = reader::trap_location(parts_->program.program(), parts_->trap);
  return where.file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
}

bool Engines::has_native() {
  return native::NativeEngine::supported();
}

}  // namespace stepwright::st_fuzz
