#pragma once

// The machine code of a whole program, and how to call it.

#include <cstdint>
#include <vector>

#include "runtime/bytecode/trap.h"
#include "runtime/native/internal/code_memory.h"
#include "runtime/native/internal/function_work.h"
#include "runtime/native/internal/machine.h"
#include "runtime/native/internal/program_facts.h"

namespace stepwright::native {

// Runs the function at that address; the number of the trap's site, 0 if there was none.
using Entry = std::uint32_t (*)(Context*, const void* function);

struct ProgramCode {
  CodeMemory memory;
  Entry enter = nullptr;
  std::vector<const void*> functions;
  std::vector<bytecode::Trap> sites;  // numbered from 1
  std::vector<CallSite> calls;        // in the order of their offsets
};

// What the library says if it cannot make the code, e.g. for want of memory.
asmjit::Error make_code(const ProgramFacts& facts, ProgramCode& out);

}  // namespace stepwright::native
