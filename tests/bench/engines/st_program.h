#pragma once

// An ST program in one of the engines.

#include <memory>
#include <string>

#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "tests/bench/engines/subject.h"
#include "tests/bench/engines/workload.h"

namespace stepwright::bench {

enum class EngineKind { Native, Vm };

// Source to verified program. Throws std::runtime_error with the diagnostics.
reader::LoadedProgram compile_st(const std::string& text);

class StProgram final : public Subject {
 public:
  // Throws std::runtime_error if the workload does not compile.
  StProgram(const Workload& workload, EngineKind kind);

  void set(std::span<const std::uint8_t> bools, std::span<const float> reals) override;
  void scan(std::int64_t now_ns) override;
  std::vector<double> results() override;

 private:
  std::vector<reader::Variable> find(const std::vector<std::string>& paths) const;

  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  std::vector<std::uint64_t> stack_;
  std::vector<std::byte> quick_code_;
  std::unique_ptr<bytecode::Engine> engine_;
  bytecode::Invocation invocation_;
  std::vector<reader::Variable> bools_, reals_, results_;
};

}  // namespace stepwright::bench
