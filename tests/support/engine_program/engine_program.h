#pragma once

// A program in Structured Text, compiled, verified and held ready in one of the engines: its memory, its
// variables, its calls. For benchmarks that look at memory and engine without a runtime around them.
//
// Thread rule: one thread. Throws std::runtime_error with the diagnostics where a program does not compile.
//
//   EngineProgram program(compile_st(text), EngineKind::Native);
//   program.memory()[program.variable("main.on").address] = std::byte{1};
//   program.scan(now_ns);

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ladder/driver/watcher.h"
#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::support {

enum class EngineKind { Native, Vm };

// Source to verified program.
reader::LoadedProgram compile_st(const std::string& text, std::span<const driver::Watcher> watchers = {});

class EngineProgram {
 public:
  EngineProgram(reader::LoadedProgram loaded, EngineKind kind);

  // All programs of the first task, one after the other. False once one has trapped.
  bool scan(std::int64_t now_ns = 0) {
    for (bytecode::Invocation& call : calls_) {
      call.now_ns = now_ns;
      std::uint64_t budget = kBudget;
      trapped_ = trapped_ || engine_->run(call, memory_, budget);
    }
    return !trapped_;
  }
  bool trapped() const { return trapped_; }
  std::span<std::byte> memory() { return memory_; }
  std::span<const std::byte> memory() const { return memory_; }
  // Throws where there is none of that name.
  reader::Variable variable(const std::string& path) const;

 private:
  static constexpr std::uint64_t kBudget = std::uint64_t{1} << 40;

  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  std::vector<std::uint64_t> stack_;
  std::vector<std::byte> quick_code_;
  std::unique_ptr<bytecode::Engine> engine_;
  std::vector<bytecode::Invocation> calls_;
  reader::ProgramInfo info_;
  bool trapped_ = false;
};

}  // namespace stepwright::support
