#include "tests/bench/engines/st_program.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <variant>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::bench {

namespace {

constexpr std::uint64_t kBudget = std::uint64_t{1} << 40;

}  // namespace

reader::LoadedProgram compile_st(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"bench.st", text});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  auto loaded = reader::LoadedProgram::load(std::move(output->container), "bench");
  if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
  return std::move(*loaded);
}

StProgram::StProgram(const Workload& workload, EngineKind kind)
    : loaded_(compile_st(workload.st)),
      memory_(loaded_.program().memory_size()),
      stack_(loaded_.program().sizes().stack_slots),
      quick_code_(loaded_.program().container().section(bytecode::Section::Code).size()) {
  const bytecode::Program& program = loaded_.program();
  if (kind == EngineKind::Vm) {
    engine_ = std::make_unique<vm::Interpreter>(program, stack_, quick_code_);
  } else {
    auto compiled = native::NativeEngine::compile(program);
    if (!compiled) throw std::runtime_error(result::to_string(compiled.error()));
    engine_ = std::move(*compiled);
  }
  const auto initial = program.container().section(bytecode::Section::InitialData);
  std::copy(initial.begin(), initial.end(), memory_.begin());
  const auto call = program.container().record<bytecode::Section::ProgramCalls>(0);
  invocation_ = {call.function, call.instance, 0, program.frames_of(0)};
  bools_ = find(workload.bools);
  reals_ = find(workload.reals);
  results_ = find(workload.results);
}

std::vector<reader::Variable> StProgram::find(const std::vector<std::string>& paths) const {
  const auto info = reader::ProgramInfo::read(loaded_.bytes());
  std::vector<reader::Variable> found;
  for (const std::string& path : paths) {
    const reader::Variable* const variable = info->find(path);
    if (variable == nullptr) throw std::runtime_error("no variable " + path);
    found.push_back(*variable);
  }
  return found;
}

void StProgram::set(std::span<const std::uint8_t> bools, std::span<const float> reals) {
  for (std::size_t i = 0; i < bools_.size(); ++i) memory_[bools_[i].address] = std::byte{bools[i]};
  for (std::size_t i = 0; i < reals_.size(); ++i) std::memcpy(&memory_[reals_[i].address], &reals[i], 4);
}

void StProgram::scan(std::int64_t now_ns) {
  invocation_.now_ns = now_ns;
  std::uint64_t budget = kBudget;
  if (engine_->run(invocation_, memory_, budget)) throw std::runtime_error("the program trapped");
}

std::vector<double> StProgram::results() {
  std::vector<double> values;
  for (const reader::Variable& variable : results_) {
    values.push_back(std::visit(
        [](const auto& value) {
          if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
            // A REAL is read as the shortest decimal number that it stands for.
            return static_cast<double>(static_cast<float>(value));
          } else {
            return 0.0;
          }
        },
        reader::read_value(variable, memory_)));
  }
  return values;
}

}  // namespace stepwright::bench
