#pragma once

// The fast engine: turns a verified program into x86-64 machine code (with AsmJit) and runs that. For equal
// input it leaves the same image, the same trap and the same budget as vm::Interpreter, bit for bit
// (runtime/doc/native.md).
//
// Thread rule: as bytecode::Engine; compile on any thread; engines that share their code (`another`) may run
// at the same time. Invariants: no page is writable and executable at
// the same time; every fault is an explicit check, no signal is used; running takes no heap and no lock.
//
//   auto engine = native::NativeEngine::compile(program);
//   if (!engine) ...  // use the interpreter
//   bytecode::Trap trap = (*engine)->run({.function = 0, .instance = 3, .now_ns = 0, .frames = 64},
//                                           memory, budget);

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/program.h"
#include "runtime/ground/result/result.h"

namespace stepwright::native {

class NativeEngine final : public bytecode::Engine {
 public:
  // True if this machine can run the code that is made.
  static bool supported();

  // Checked is for tests: slower code that also proves, as it runs, what the loops' registers rely on
  // (runtime/doc/native.md). On AArch64 both are the same.
  enum class Form : std::uint8_t { Plain, Checked };

  // Fails (code "R0010") where the machine is not supported or gives no memory for code. The program's bytes
  // may go away afterwards.
  [[nodiscard]] static result::Result<std::unique_ptr<NativeEngine>> compile(const bytecode::Program& program,
                                                                             Form form = Form::Plain);

  // An engine of its own on the same machine code, for another thread: nothing is compiled, and it takes no
  // more than the memory for its calls and slots.
  std::unique_ptr<NativeEngine> another() const;

  ~NativeEngine() override;

  // Requires a program call of the program: function, instance and frames as a task has them.
  bytecode::Trap run(const bytecode::Invocation& invocation, std::span<std::byte> memory,
                     std::uint64_t& budget) override;
  void set_interrupt(const bytecode::Interrupt* interrupt) override;

  // Of the checked form: the first instruction, of all runs, at which what the translator relies on did not
  // hold.
  struct BrokenCheck {
    std::uint32_t function = 0;
    std::uint32_t pc = 0;
  };
  std::optional<BrokenCheck> broken_check() const;

  // Bytes of machine code, constants included.
  std::size_t code_bytes() const;

 private:
  struct Code;
  struct Parts;
  explicit NativeEngine(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace stepwright::native
