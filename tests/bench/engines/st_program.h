#pragma once

// The ST program of a workload in one of the engines.

#include <string>
#include <vector>

#include "tests/bench/engines/subject.h"
#include "tests/bench/engines/workload.h"
#include "tests/support/engine_program/engine_program.h"

namespace stepwright::bench {

using support::compile_st;
using support::EngineKind;
using support::EngineProgram;

class StProgram final : public Subject {
 public:
  // Throws std::runtime_error if the workload does not compile.
  StProgram(const Workload& workload, EngineKind kind);

  void set(std::span<const std::uint8_t> bools, std::span<const float> reals) override;
  void scan(std::int64_t now_ns) override;
  std::vector<double> results() override;

 private:
  std::vector<reader::Variable> find(const std::vector<std::string>& paths) const;

  EngineProgram program_;
  std::vector<reader::Variable> bools_, reals_, results_;
};

}  // namespace stepwright::bench
