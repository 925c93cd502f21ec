#include "tests/bench/engines/st_program.h"

#include <cstring>
#include <stdexcept>
#include <variant>

#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::bench {

StProgram::StProgram(const Workload& workload, EngineKind kind)
    : program_(compile_st(workload.st), kind),
      bools_(find(workload.bools)),
      reals_(find(workload.reals)),
      results_(find(workload.results)) {}

std::vector<reader::Variable> StProgram::find(const std::vector<std::string>& paths) const {
  std::vector<reader::Variable> found;
  for (const std::string& path : paths) found.push_back(program_.variable(path));
  return found;
}

void StProgram::set(std::span<const std::uint8_t> bools, std::span<const float> reals) {
  const std::span<std::byte> memory = program_.memory();
  for (std::size_t i = 0; i < bools_.size(); ++i) memory[bools_[i].address] = std::byte{bools[i]};
  for (std::size_t i = 0; i < reals_.size(); ++i) std::memcpy(&memory[reals_[i].address], &reals[i], 4);
}

void StProgram::scan(std::int64_t now_ns) {
  if (!program_.scan(now_ns)) throw std::runtime_error("the program trapped");
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
        reader::read_value(variable, program_.memory())));
  }
  return values;
}

}  // namespace stepwright::bench
