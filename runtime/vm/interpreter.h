#pragma once

// The portable engine: interprets a verified program, instruction by instruction (direct threading).
// Boolean code has no data-dependent branches: its cost depends on the program, not on the inputs.
//
// Thread rule: as bytecode::Engine. Invariant: between two runs the stack holds nothing.
//
//   std::vector<std::uint64_t> stack(program.sizes().stack_slots);
//   std::vector<std::byte> quick(program.container().section(bytecode::Section::Code).size());
//   vm::Interpreter engine(program, stack, quick);
//   std::uint64_t budget = 1'000'000;
//   const bytecode::Invocation invocation{.function = 0, .instance = 3, .frames = program.frames_of(0)};
//   bytecode::Trap trap = engine.run(invocation, memory, budget);

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/program.h"

namespace stepwright::vm {

class Interpreter final : public bytecode::Engine {
 public:
  // The program's bytes and the stack (sizes().stack_slots at least) must outlive the engine.
  Interpreter(const bytecode::Program& program, std::span<std::uint64_t> stack);

  // Fills `quick_code` (as many bytes as the Code section has; it must outlive the engine) with the quick
  // form of the code and runs that: the same meaning, traps and budget in fewer steps (superinstruction.h).
  // A program built with STEPWRIGHT_PLAIN_INTERPRETER lacks it: 12 KB of code and the copy are too much for a
  // small controller.
  Interpreter(const bytecode::Program& program, std::span<std::uint64_t> stack,
              std::span<std::byte> quick_code);

  // Runs the same code, quick or not, on a stack of its own: for another thread.
  Interpreter another(std::span<std::uint64_t> stack) const {
    Interpreter other = *this;
    other.stack_ = stack;
    other.interrupt_ = nullptr;
    return other;
  }

  // Requires a function that a task calls (ProgramCallRecord): the stack is sized for those.
  bytecode::Trap run(const bytecode::Invocation& invocation, std::span<std::byte> memory,
                     std::uint64_t& budget) override;
  void set_interrupt(const bytecode::Interrupt* interrupt) override { interrupt_ = interrupt; }

 private:
  bytecode::Program program_;
  std::span<std::uint64_t> stack_;
  std::span<const std::byte> code_;  // the file's, or its quick form
  const bytecode::Interrupt* interrupt_ = nullptr;
};

}  // namespace stepwright::vm
