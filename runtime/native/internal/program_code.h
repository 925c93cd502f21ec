#pragma once

// The machine code of a whole program, and how to call it.

#include <cstdint>
#include <vector>

#include "runtime/bytecode/trap.h"
#include "runtime/native/internal/code_memory.h"
#include "runtime/native/internal/context.h"
#include "runtime/native/internal/program_facts.h"

namespace stepwright::native {

// Runs the function at that address; the number of the trap's site, 0 if there was none.
using Entry = std::uint32_t (*)(Context*, const void* function);

// Call that a return address belongs to: it is in this function, `return_pc` is behind its instruction.
struct CallSite {
  std::size_t offset = 0;  // of the address in the code
  std::uint32_t function = 0;
  std::uint32_t return_pc = 0;
};

// An instruction of the bytecode.
struct CodePlace {
  std::uint32_t function = 0;
  std::uint32_t pc = 0;
};

struct ProgramCode {
  CodeMemory memory;
  Entry enter = nullptr;
  std::vector<const void*> functions;
  std::vector<bytecode::Trap> sites;  // numbered from 1
  std::vector<CallSite> calls;        // in the order of their offsets
  std::vector<CodePlace> checks;      // of checked code, numbered from 1

  // Takes over the finished code.
  asmjit::Error place(asmjit::CodeHolder& holder, asmjit::Label entry_label,
                      const std::vector<asmjit::Label>& function_labels);
};

// The first error is what the library is asked for at the end; emitting goes on without effect.
class FirstError final : public asmjit::ErrorHandler {
 public:
  void handleError(asmjit::Error error, const char*, asmjit::BaseEmitter*) override {
    if (first == asmjit::kErrorOk) first = error;
  }
  asmjit::Error first = asmjit::kErrorOk;
};

// Makes the code of a program; one implementation for each kind of processor. Returns the library's error,
// e.g. for want of memory. Checked code exists on x86-64 only, where loops keep variables in registers;
// elsewhere it is the plain one.
asmjit::Error make_code(const ProgramFacts& facts, bool checked, ProgramCode& out);

}  // namespace stepwright::native
