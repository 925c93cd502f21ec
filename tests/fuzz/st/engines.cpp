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

reader::LoadedProgram load(const std::string& text, const graphic::Project* project) {
  driver::CompileInput input;
  input.texts.push_back({"fuzz.st", text});
  if (project != nullptr) input.projects.push_back(project);
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  auto loaded = reader::LoadedProgram::load(std::move(output->container), "fuzz");
  if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
  return std::move(*loaded);
}

std::string shown(const bytecode::Trap& trap) {
  return std::string(bytecode::name_of(trap.code)) + " in " + std::to_string(trap.function) + " at " +
         std::to_string(trap.pc) + ", called in " + std::to_string(trap.caller) + " before " +
         std::to_string(trap.return_pc);
}

// Of the engines beside the first, which is the interpreter of the code as it is.
std::string name_of(std::size_t engine) {
  return engine == 1 ? "quick" : engine == 2 ? "native" : "checked";
}

std::unique_ptr<native::NativeEngine> native_engine(const bytecode::Program& program,
                                                    native::NativeEngine::Form form) {
  auto engine = native::NativeEngine::compile(program, form);
  if (!engine) throw std::runtime_error(result::to_string(engine.error()));
  return std::move(*engine);
}

}  // namespace

struct Engines::Parts {
  Parts(const std::string& text, const graphic::Project* project)
      : program(load(text, project)),
        info(reader::ProgramInfo::read(program.bytes()).value()),
        stack(program.program().sizes().stack_slots),
        quick_code(program.program().container().section(bytecode::Section::Code).size()) {
    engines.push_back(std::make_unique<vm::Interpreter>(program.program(), stack));
    engines.push_back(std::make_unique<vm::Interpreter>(program.program(), stack, quick_code));
    if (has_native()) {
      engines.push_back(native_engine(program.program(), native::NativeEngine::Form::Plain));
      auto proving = native_engine(program.program(), native::NativeEngine::Form::Checked);
      checked = proving.get();
      engines.push_back(std::move(proving));
    }
    const auto initial = program.program().container().section(bytecode::Section::InitialData);
    std::vector<std::byte> memory(program.program().memory_size());
    std::ranges::copy(initial, memory.begin());
    memories.assign(engines.size(), memory);
    const auto& view = program.program().container();
    for (std::uint32_t i = 0; i < view.count<bytecode::Section::Tasks>(); ++i) tasks.push_back(i);
    std::ranges::stable_sort(tasks, {}, [&](std::uint32_t task) { return record(task).priority; });
  }

  bytecode::TaskRecord record(std::uint32_t task) const {
    return program.program().container().record<bytecode::Section::Tasks>(task);
  }

  std::string run(const bytecode::Invocation& invocation);
  std::string compare() const;

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
  const native::NativeEngine* checked = nullptr;  // one of them
  std::vector<std::vector<std::byte>> memories;
  std::vector<std::uint32_t> tasks;  // the one that goes first first
  std::int64_t now_ns = 0;
  bytecode::Trap trap;
};

// One program on all engines.
std::string Engines::Parts::run(const bytecode::Invocation& invocation) {
  std::uint64_t left = kBudget;
  trap = engines[0]->run(invocation, memories[0], left);
  std::string out;
  for (std::size_t i = 1; i < engines.size(); ++i) {
    std::uint64_t other_left = kBudget;
    const bytecode::Trap other = engines[i]->run(invocation, memories[i], other_left);
    if (other != trap) out += "trap: " + shown(trap) + ", " + name_of(i) + ": " + shown(other) + "\n";
    if (left != other_left)
      out += "budget left: " + std::to_string(left) + ", " + name_of(i) + ": " + std::to_string(other_left) +
             "\n";
  }
  if (checked != nullptr && checked->broken_check())
    out += "check broken in " + std::to_string(checked->broken_check()->function) + " at " +
           std::to_string(checked->broken_check()->pc) + "\n";
  return out + compare();
}

// Frames have no value between scans.
std::string Engines::Parts::compare() const {
  for (std::size_t i = 1; i < memories.size(); ++i) {
    for (std::size_t at = 0; at < program.program().image_size(); ++at) {
      if (memories[0][at] == memories[i][at]) continue;
      return "byte " + std::to_string(at) + " of the image differs in " + name_of(i) + "\n";
    }
  }
  return {};
}

Engines::Engines(const std::string& text, const graphic::Project* project)
    : parts_(std::make_unique<Parts>(text, project)) {}
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
  const auto& view = p.program.program().container();
  std::string out;
  p.trap = {};
  for (const std::uint32_t task : p.tasks) {
    const bytecode::TaskRecord record = p.record(task);
    if (p.now_ns % (std::int64_t{record.interval_us} * 1000) != 0) continue;
    for (std::uint32_t i = 0; i < record.call_count && !p.trap && out.empty(); ++i) {
      const auto call = view.record<bytecode::Section::ProgramCalls>(record.first_call + i);
      out += p.run({call.function, call.instance, p.now_ns, p.program.program().frames_of(task)});
    }
  }
  p.now_ns += kInterval;
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
